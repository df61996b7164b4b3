// Writes what the scripts beside it let others' programs load, of straight and of curved tets:
//     FOLDER/solver/bar*.inp      a slender bar of tets, along an axis that no coordinate axis is
//     FOLDER/solver/muscle*.inp   the biceps of a scan, meshed
//     FOLDER/solver/curved.*      the same biceps and its tendons in every format that has tets of ten nodes
//     FOLDER/solver/expected.json per stem: tissues with label, tets, nodes, volume (of the tets' corners)
#include "sinew/MeshIO/CombineMeshes.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/Pipeline/MeshTissues.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/TestSupport/ElasticBars.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

#include <iostream>

namespace {

using namespace sinew;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array kQuadraticFormats{".msh", ".inp", ".feb", ".exo"};

/// A box of 2 x 2 x 20 mm, turned.
TissueMesh bar() {
  TissueMesh bar{test::barMesh({4, 4, 40}, 0.5), {{1, "a \"bar\""}}, {}};
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  for (Eigen::Vector3d& x : bar.mesh.nodes) x = turn * x + Eigen::Vector3d(30, -40, 500);
  return bar;
}

/// The tissues of a segmentation, meshed.
std::vector<TissueMesh> meshed(const fs::path& scan, const std::vector<int>& tissues,
                               const fs::path& folder) {
  const Segmentation segmentation = readSegmentation(scan);
  std::vector<TissueMesh> meshes;
  for (const TissueReport& report : meshTissues(segmentation, tissues, folder, {}))
    meshes.push_back(readMesh(folder / report.file));
  return meshes;
}

Json expectedOf(const TissueMesh& mesh) {
  Json tissues = Json::array();
  for (const TissueRegion& region : mesh.regions) {
    std::int64_t tets = 0;
    double volume = 0;
    for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t) {
      if (mesh.mesh.labels[t] != region.label) continue;
      const auto& [a, b, c, d] = mesh.mesh.tets[t];
      const auto& x = mesh.mesh.nodes;
      ++tets;
      volume += (x[b] - x[a]).cross(x[c] - x[a]).dot(x[d] - x[a]) / 6;
    }
    tissues.push_back(
        {{"label", region.label}, {"name", region.name}, {"tets", tets}, {"volume_mm3", volume}});
  }
  return tissues;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) throw std::invalid_argument("usage: SolverFiles SCAN FOLDER");
  const fs::path folder = fs::path(argv[2]) / "solver";
  fs::remove_all(folder);
  fs::create_directories(folder / "meshed");

  constexpr int kBiceps = 1, kTendons = 2;
  std::vector<TissueMesh> tissues = meshed(argv[1], {kBiceps, kTendons}, folder / "meshed");
  const TissueMesh muscle = tissues.front();
  writeMesh(bar(), folder / "bar.inp");
  writeMesh(bar(), folder / "bar-quadratic.inp", {.quadratic = true});
  writeMesh(muscle, folder / "muscle.inp");
  writeMesh(muscle, folder / "muscle-quadratic.inp", {.quadratic = true});
  const TissueMesh curved = combineMeshes(std::move(tissues));
  for (const char* extension : kQuadraticFormats)
    writeMesh(curved, folder / (std::string("curved") + extension), {.quadratic = true});

  const Json expected{
      {"bar", expectedOf(bar())}, {"muscle", expectedOf(muscle)}, {"curved", expectedOf(curved)}};
  writeTextFile(folder / "expected.json", expected.dump(2) + "\n");
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
