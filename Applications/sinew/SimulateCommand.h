#pragma once

#include "TissueFibres.h"
#include "sinew/Simulation/TrialTable.h"

#include <ostream>
#include <string>
#include <vector>

namespace sinew {

/// One run of `sinew simulate`.
struct SimulateCommand {
  std::vector<std::string> meshes;
  std::string folder;
  bool compare = false, noSeries = false;
  FibreSettings fibres;
  TrialOptions trial;
};

/// What a run did with one mesh.
struct SimulatedMesh {
  std::string file, name;  ///< as given; short and unlike the others, for people
  std::string series;      ///< its .pvd in the folder; empty: none
  std::string tissue;
  std::int64_t tets = 0, nodes = 0, originNodes = 0, insertionNodes = 0;
  const char* fibres = "";             ///< where they come from; empty for trials without
  std::int64_t tetsOutsideSpline = 0;  ///< see TissueFibres::outside
  double seconds = 0;
};

struct Simulation {
  std::vector<SimulatedMesh> meshes;
  std::vector<NamedTrial> trials;  ///< of each mesh
  std::string table, plot;         ///< names of files in the folder
  double seconds = 0;
};

/// The machine-readable result.
std::string toJson(const SimulateCommand& command, const Simulation& simulation);

/// For people: meshes worst to best when there are several, and a verdict for each.
void print(std::ostream& stream, const Simulation& simulation);

}  // namespace sinew
