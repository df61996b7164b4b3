// Writes what the scripts beside it show to other programs: a tilted, anisotropic phantom far from the origin
// as plain label maps with their tables, two overlapping tissues as a layered Slicer segmentation, and what
// must be found in them.
#include "sinew/Segmentation/Phantom.h"
#include "sinew/Segmentation/WriteLabelMap.h"
#include "sinew/Segmentation/WriteLabelTable.h"
#include "sinew/Segmentation/WriteSegmentation.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <iostream>

namespace {

using namespace sinew;
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

Segmentation farAndTilted(const std::string& phantom) {
  Segmentation segmentation =
      makePhantom(phantom, {.spacing = Eigen::Vector3d(1.5, 1.75, 2.25), .tiltDeg = 30});
  segmentation.geometry.origin += Eigen::Vector3d(137.3, -81.7, 413.1);
  segmentation.tissues[0].name = "M\u00fcskel \"left\", under_score";
  return segmentation;
}

Eigen::Vector3d centroid(const Segmentation& segmentation, const Tissue& tissue) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = tissue.box.lower.z(); k < tissue.box.upper.z(); ++k)
    for (int j = tissue.box.lower.y(); j < tissue.box.upper.y(); ++j)
      for (int i = tissue.box.lower.x(); i < tissue.box.upper.x(); ++i)
        if (segmentation.at(tissue.layer, {i, j, k}) == tissue.label) sum += Eigen::Vector3d(i, j, k);
  return sum / static_cast<double>(tissue.voxels);
}

Json json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json expected(const Segmentation& segmentation) {
  Json tissues = Json::array();
  for (const Tissue& tissue : segmentation.tissues) {
    const Eigen::Vector3d voxel = centroid(segmentation, tissue);
    tissues.push_back({{"id", tissue.id},
                       {"name", tissue.name},
                       {"label", tissue.label},
                       {"layer", tissue.layer},
                       {"color", tissue.color},
                       {"voxels", tissue.voxels},
                       {"centroid_voxel", json(voxel)},
                       {"centroid_lps_mm", json(segmentation.geometry.indexToPhysical() * voxel)}});
  }
  Json affine = Json::array();
  for (int row = 0; row < 4; ++row) {
    const Eigen::RowVector4d line = segmentation.geometry.indexToPhysical().matrix().row(row);
    affine.push_back({line[0], line[1], line[2], line[3]});
  }
  return {{"lps_from_voxel", affine}, {"layers", segmentation.layers.size()}, {"tissues", tissues}};
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::invalid_argument("usage: ExchangeLabelMaps FOLDER");
  const fs::path folder = argv[1];
  fs::remove_all(folder);
  fs::create_directories(folder);
  const Segmentation plain = farAndTilted("upper-arm"), layered = farAndTilted("overlapping-muscles");
  for (const char* name : {"plain.nrrd", "plain.nii", "plain.nii.gz", "plain.mha", "plain.mhd"})
    writeLabelMap(plain, folder / name);
  for (const char* name : {"plain.ctbl", "plain.csv", "plain_dseg.tsv"})
    writeLabelTable(labelTable(plain), folder / name);
  writeSegmentation(plain, folder / "plain.seg.nrrd");
  writeSegmentation(layered, folder / "layered.seg.nrrd");
  std::ofstream(folder / "expected.json")
      << Json{{"plain", expected(plain)}, {"layered", expected(layered)}}.dump(2) << '\n';
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
