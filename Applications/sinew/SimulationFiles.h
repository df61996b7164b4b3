#pragma once

#include "SimulateCommand.h"
#include "sinew/MeshIO/MeshSeries.h"

#include <filesystem>

namespace sinew {

/// Names for people: the last parts of each path, as many as it takes to tell it from the others.
/// @throws CLI::ValidationError when a mesh is given twice
std::vector<std::string> shortNames(const std::vector<std::string>& files);

/// Legal and unlike each other, for names of files: those of `names` without their ends.
std::vector<std::string> stemsOf(const std::vector<std::string>& names);

/// The files of a run in its folder.
struct TrialOutputs {
  std::string report, table, plot;
  std::vector<std::string> stems;  ///< how the names of the series of each mesh begin

  /// Those that are there: of an older run of the same trial, whatever the number of its frames.
  std::vector<std::string> olderIn(const std::filesystem::path& folder) const;
};

TrialOutputs trialOutputs(const SimulateCommand& command, const std::vector<std::string>& meshNames);

/// Those of `names` that are not in the folder.
std::vector<std::string> missingIn(const std::filesystem::path& folder, std::vector<std::string> names);

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
  /// Whether a file may be the list or a frame of such a series.
  static bool owns(const std::string& stem, const std::string& name);

 private:
  std::filesystem::path folder_;
  std::string stem_;
  TissueMesh mesh_;
  ElasticBody body_;
  NodeVectors fibres_;
  std::vector<SeriesMesh> frames_;
};

}  // namespace sinew
