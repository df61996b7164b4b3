// Meshes a phantom and stretches two tets with an installed Sinew: consumer FOLDER
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
  const sinew::TetMesh twoTets{.nodes = {{0, 0, -1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, 1}},
                               .tets = {{1, 2, 3, 4}, {1, 3, 2, 0}},
                               .labels = {1, 1},
                               .kinds = {}};
  const sinew::TrialReport stretch =
      sinew::runTrial(twoTets, {.attachments = {{0}, {4}}}, {.trial = sinew::Trial::Stretch});
  std::cout << stretch.verdict << '\n';
  complete &= stretch.completed;
  return complete ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
