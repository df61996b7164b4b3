// Meshes a phantom and stretches a tet with an installed Sinew: consumer FOLDER
#include <exception>
#include <iostream>
#include <sinew/MeshIO/ReadMesh.h>
#include <sinew/Pipeline/MeshTissues.h>
#include <sinew/Segmentation/Phantom.h>
#include <sinew/Simulation/MeshTrial.h>

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "usage: consumer FOLDER\n";
    return 2;
  }
  const std::filesystem::path folder = argv[1];
  const sinew::Segmentation sphere = sinew::makePhantom("sphere", {.spacing = Eigen::Vector3d(2, 2, 2)});
  bool complete = true;
  for (const sinew::TissueReport& report : sinew::meshTissues(sphere, {0}, folder, {.edgeLength = 5})) {
    std::cout << report.name << ": " << report.quality.tets << " tets, " << report.quality.nodes << " nodes "
              << report.message << '\n';
    complete &= report.status == sinew::TissueStatus::Meshed && report.conditions.good();
    if (!report.file.empty())
      complete &= std::ssize(sinew::readMesh(folder / report.file).mesh.tets) == report.quality.tets;
  }
  const sinew::TetMesh tet{.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                           .tets = {{0, 1, 2, 3}},
                           .labels = {1},
                           .kinds = {}};
  const sinew::TrialSetup ends{.attachments = {{0, 1, 2}, {3}}};
  std::cout << sinew::runTrial(tet, ends, {.trial = sinew::Trial::Stretch}).verdict << '\n';
  return complete ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
