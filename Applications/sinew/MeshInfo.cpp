#include "MeshInfo.h"

#include "JsonReport.h"
#include "TextTable.h"
#include "sinew/MeshIO/ReadMesh.h"

#include <map>

namespace sinew {
namespace {

/// One for every label, named by the file or not at all.
std::vector<MeshInfo::Region> regionsOf(const TissueMesh& mesh) {
  std::map<std::int32_t, MeshInfo::Region> sums;
  for (std::size_t t = 0; t < mesh.mesh.tets.size(); ++t) {
    const auto& [a, b, c, d] = mesh.mesh.tets[t];
    const auto& x = mesh.mesh.nodes;
    const double volume = (x[b] - x[a]).cross(x[c] - x[a]).dot(x[d] - x[a]) / 6;
    MeshInfo::Region& sum = sums[mesh.mesh.labels[t]];
    ++sum.tets;
    sum.volume += volume;
    sum.centroid += volume * (x[a] + x[b] + x[c] + x[d]) / 4;
  }
  std::vector<MeshInfo::Region> regions;
  const auto take = [&](TissueRegion tissue, MeshInfo::Region sum) {
    sum.tissue = std::move(tissue);
    sum.centroid /= sum.volume;
    regions.push_back(std::move(sum));
  };
  for (const TissueRegion& region : mesh.regions)
    if (auto sum = sums.extract(region.label)) take(region, sum.mapped());
  for (const auto& [label, sum] : sums) take({label, {}}, sum);
  return regions;
}

Json toArray(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

std::string triple(const Eigen::Vector3d& v) {
  return fixed(v.x(), 2) + ", " + fixed(v.y(), 2) + ", " + fixed(v.z(), 2);
}

}  // namespace

MeshInfo describeMesh(const std::string& file) {
  const TissueMesh mesh = readMesh(file);
  MeshInfo info;
  info.file = file;
  info.nodes = std::ssize(mesh.mesh.nodes);
  info.tets = std::ssize(mesh.mesh.tets);
  for (const Eigen::Vector3d& node : mesh.mesh.nodes) info.box.extend(node);
  info.regions = regionsOf(mesh);
  return info;
}

std::string toJson(const MeshInfo& mesh) {
  Json json = programFields();
  json["input"] = mesh.file;
  json["nodes"] = mesh.nodes;
  json["tets"] = mesh.tets;
  json["box_mm"] = {{"lower", toArray(mesh.box.min())}, {"upper", toArray(mesh.box.max())}};
  json["regions"] = Json::array();
  for (const MeshInfo::Region& region : mesh.regions)
    json["regions"].push_back({{"name", region.tissue.name},
                               {"label", region.tissue.label},
                               {"color", region.tissue.color},
                               {"tets", region.tets},
                               {"volume_mm3", region.volume},
                               {"centroid_mm", toArray(region.centroid)}});
  return document(json);
}

void print(std::ostream& stream, const MeshInfo& mesh) {
  stream << mesh.file << "\n  tets       " << grouped(mesh.tets) << "\n  nodes      " << grouped(mesh.nodes)
         << "\n  from       " << triple(mesh.box.min()) << " mm (LPS)\n  to         "
         << triple(mesh.box.max()) << "\n\n";
  TextTable table({{"label"}, {"tissue", Align::Left}, {"colour", Align::Left}, {"tets"}, {"mm^3"}});
  for (const MeshInfo::Region& region : mesh.regions)
    table.add({std::to_string(region.tissue.label), printable(region.tissue.name),
               colourCode(region.tissue.color), grouped(region.tets), fixed(region.volume, 1)});
  table.print(stream);
}

}  // namespace sinew
