// Writes the files that the scripts beside it show to other programs: a tilted, anisotropic scan far from the
// origin, its two overlapping tissues meshed, in every format, and what must be found in them.
//     FOLDER/lps, FOLDER/ras   each tissue and both together in every format, in that space
//     FOLDER/untagged          the same in LPS, without a mark
//     FOLDER/scene             the tissues as .vtu, and a scene
//     FOLDER/expected.json     per file: tissues with label, tets, volume, and the barycentre of their
//     voxels, LPS mm
#include "sinew/MeshIO/CombineMeshes.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/SlicerScene.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/Pipeline/FileNames.h"
#include "sinew/Pipeline/MeshTissues.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Segmentation/Phantom.h"
#include "sinew/Segmentation/WriteSegmentation.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <numeric>

namespace {

using namespace sinew;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// No two axes alike, nothing at the origin, names that need care, and one label on two layers.
Segmentation scan() {
  Segmentation segmentation =
      makePhantom("overlapping-muscles", {.spacing = Eigen::Vector3d(1, 1.25, 2), .tiltDeg = 30});
  segmentation.geometry.origin += Eigen::Vector3d(137.25, -81.5, 413);
  segmentation.tissues[0].name = "M\u00fcskel \"left\" <a & b>";
  segmentation.tissues[1].name = "it's 100%20 / rectus";
  return segmentation;
}

Eigen::Vector3d barycentre(const Segmentation& segmentation, const Tissue& tissue) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = tissue.box.lower.z(); k < tissue.box.upper.z(); ++k)
    for (int j = tissue.box.lower.y(); j < tissue.box.upper.y(); ++j)
      for (int i = tissue.box.lower.x(); i < tissue.box.upper.x(); ++i)
        if (segmentation.at(tissue.layer, {i, j, k}) == tissue.label) sum += Eigen::Vector3d(i, j, k);
  return segmentation.geometry.indexToPhysical() * (sum / static_cast<double>(tissue.voxels));
}

double volume(const TetMesh& mesh) {
  return std::accumulate(mesh.tets.begin(), mesh.tets.end(), 0.0, [&](double sum, const Tet& tet) {
    const Eigen::Vector3d& a = mesh.nodes[tet[0]];
    return sum + (mesh.nodes[tet[1]] - a).cross(mesh.nodes[tet[2]] - a).dot(mesh.nodes[tet[3]] - a) / 6;
  });
}

struct TissueFile {
  std::string stem;
  TissueMesh mesh;
  Json expected;  ///< one entry for each tissue
};

std::vector<TissueFile> meshed(const Segmentation& segmentation, const fs::path& folder) {
  const std::vector<std::string> stems = tissueFileStems(segmentation.tissues);
  std::vector<int> all(segmentation.tissues.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<TissueFile> files;
  for (const TissueReport& report : meshTissues(segmentation, all, folder, {})) {
    const Tissue& tissue = segmentation.tissues[files.size()];
    TissueFile file{stems[files.size()], readMesh(folder / report.file), Json::array()};
    const Eigen::Vector3d centre = barycentre(segmentation, tissue);
    file.expected.push_back({{"label", tissue.label},
                             {"name", tissue.name},
                             {"tets", file.mesh.mesh.tets.size()},
                             {"nodes", file.mesh.mesh.nodes.size()},
                             {"volume_mm3", volume(file.mesh.mesh)},
                             {"barycentre_mm", {centre.x(), centre.y(), centre.z()}}});
    files.push_back(std::move(file));
  }
  return files;
}

TissueFile combined(const std::vector<TissueFile>& files) {
  std::vector<TissueMesh> meshes;
  TissueFile all{"combined", {}, Json::array()};
  for (const TissueFile& file : files) {
    meshes.push_back(file.mesh);
    all.expected.push_back(file.expected.front());
  }
  all.mesh = combineMeshes(std::move(meshes));
  for (std::size_t r = 0; r < all.mesh.regions.size(); ++r)
    all.expected[r]["label"] = all.mesh.regions[r].label;
  return all;
}

void writeScene(const Segmentation& segmentation, const std::vector<TissueFile>& files,
                const fs::path& folder) {
  SlicerScene scene;
  for (const TissueFile& file : files) {
    writeMesh(file.mesh, folder / (file.stem + ".vtu"));
    scene.models.push_back(
        {file.stem + ".vtu", file.mesh.regions[0].name, file.mesh.regions[0].color, 1, std::nullopt});
  }
  writeSegmentation(segmentation, folder / "scan of it.seg.nrrd");
  scene.segmentation = SceneSegmentation{"scan of it.seg.nrrd", "scan"};
  writeSlicerScene(scene, folder / "scene.mrml");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::invalid_argument("usage: ExchangeFiles FOLDER");
  const fs::path folder = argv[1];
  fs::remove_all(folder);
  for (const char* name : {"lps", "ras", "untagged", "scene", "meshed"})
    fs::create_directories(folder / name);

  const Segmentation segmentation = scan();
  std::vector<TissueFile> files = meshed(segmentation, folder / "meshed");
  writeScene(segmentation, files, folder / "scene");
  files.push_back(combined(files));

  Json expected{{"voxel_mm", segmentation.geometry.meanSpacing()}, {"files", Json::object()}};
  for (const TissueFile& file : files) {
    expected["files"][file.stem] = file.expected;
    for (const MeshFormat& format : meshFormats()) {
      const std::string name = file.stem + std::string(format.extension);
      writeMesh(file.mesh, folder / "lps" / name);
      writeMesh(file.mesh, folder / "ras" / name, {.space = Space::Ras});
      writeMesh(file.mesh, folder / "untagged" / name, {.spaceTag = false});
    }
  }
  writeTextFile(folder / "expected.json", expected.dump(2) + "\n");
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
