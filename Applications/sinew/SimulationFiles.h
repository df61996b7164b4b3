#pragma once

#include "SimulateCommand.h"
#include "sinew/MeshIO/MeshSeries.h"

#include <filesystem>

namespace sinew {

/// Names for people: the last parts of each path, as many as it takes to tell it from the others.
/// @throws std::invalid_argument when a mesh is given twice
std::vector<std::string> shortNames(const std::vector<std::string>& files);

/// Legal and unlike each other, for names of files: those of `names` without their ends.
std::vector<std::string> stemsOf(const std::vector<std::string>& names);

/// The frames of a trial as files: the mesh as it is then, with the arrays displacement (of nodes, mm), fibres
/// (as they lie now), aspect_ratio and J (volume now over that at rest).
class TrialSeries {
 public:
  /// @param stem  how the names of the files begin
  TrialSeries(std::filesystem::path folder, std::string stem, TissueMesh rest, NodeVectors fibres);

  void add(double time, const NodeVectors& places);
  /// Writes the list of them.
  void finish() const;

  static std::string listName(const std::string& stem) { return stem + ".pvd"; }
  static std::string frameName(const std::string& stem, std::size_t frame);

 private:
  std::filesystem::path folder_;
  std::string stem_;
  TissueMesh mesh_;
  ElasticBody body_;
  NodeVectors fibres_;
  std::vector<SeriesMesh> frames_;
};

}  // namespace sinew
