#include "sinew/Pipeline/Report.h"

#include "TopologyDifferences.h"
#include "sinew/Pipeline/Memory.h"
#include "sinew/Pipeline/MethodSettings.h"
#include "sinew/Segmentation/TissueCentroid.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sys/utsname.h>
#include <thread>

namespace sinew {
namespace {

using Json = nlohmann::ordered_json;  // keeps the order in which fields are written here

Json toArray(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json toJsonObject(const MeshQuality& quality) {
  return {{"max_aspect_ratio", quality.maxAspectRatio},  {"mean_aspect_ratio", quality.meanAspectRatio},
          {"min_dihedral_deg", quality.minDihedralDeg},  {"max_dihedral_deg", quality.maxDihedralDeg},
          {"max_over_min_edge", quality.maxOverMinEdge}, {"inverted", quality.inverted}};
}

Json toJsonObject(const MeshConditions& conditions) {
  return {{"faces_of_many_tets", conditions.facesOfManyTets},
          {"nonmanifold_edges", conditions.nonmanifoldEdges},
          {"nonmanifold_nodes", conditions.nonmanifoldNodes},
          {"tets_with_four_boundary_nodes", conditions.tetsWithFourBoundaryNodes},
          {"interior_edges_between_boundary_nodes", conditions.interiorEdgesBetweenBoundaryNodes},
          {"interior_faces_with_three_boundary_nodes", conditions.interiorFacesWithThreeBoundaryNodes}};
}

Json toJsonObject(const MeshTopology& topology) {
  return {{"components", topology.components},
          {"boundary_components", topology.boundaryComponents},
          {"euler_characteristic", topology.eulerCharacteristic}};
}

Json toJsonObject(const Fidelity& fidelity) {
  return {{"surface_offset_mm", fidelity.surfaceOffset},
          {"max_boundary_phi_mm", fidelity.maxBoundaryPhi},
          {"surface_rms_mm", fidelity.surfaceRms},
          {"surface_max_mm", fidelity.surfaceMax},
          {"surface_max_place_mm", toArray(fidelity.surfaceMaxPlace)},
          {"volume_mm3", fidelity.volume},
          {"label_volume_mm3", fidelity.labelVolume},
          {"level_set_volume_mm3", fidelity.levelSetVolume},
          {"dice", fidelity.dice}};
}

Json toJsonObject(const LostPieces& lost) {
  return {{"components", lost.components}, {"volume_mm3", lost.volume}};
}

Json toJsonObject(const CurvedBoundary& curved) {
  return {{"boundary_edges", curved.boundaryEdges},
          {"pulled_back", curved.pulledBackEdges},
          {"straightened", curved.straightenedEdges},
          {"away_from_the_surface", curved.awayEdges}};
}

Json toJsonArray(const std::vector<WorstElement>& worst) {
  Json list = Json::array();
  for (const WorstElement& element : worst)
    list.push_back({{"measure", element.measure},
                    {"element", element.element},
                    {"value", element.value},
                    {"place_mm", toArray(element.place)}});
  return list;
}

Json toJsonArray(const std::vector<TopologyDifference>& differences) {
  Json list = Json::array();
  for (const TopologyDifference& difference : differences)
    list.push_back({{"change", toString(difference.change)},
                    {"place_mm", toArray(difference.place)},
                    {"width_mm", difference.width},
                    {"euler_characteristic", difference.euler},
                    {"volume_mm3", difference.volume},
                    {"reason", difference.reason}});
  return list;
}

/// Bins by their lower ends.
template <class Counts>
Json toJsonObject(const Json& from, const Counts& counts) {
  return {{"from", from}, {"counts", counts}};
}

Json toJsonObject(const QualityHistogram& histogram) {
  Json degrees = Json::array();
  for (std::size_t bin = 0; bin < kDihedralBins; ++bin) degrees.push_back(kDihedralBinDeg * double(bin));
  return {{"dihedral_deg", toJsonObject(degrees, histogram.dihedrals)},
          {"aspect_ratio", toJsonObject(kAspectRatioBins, histogram.aspectRatios)}};
}

/// Null where the method has no physics.
Json toJsonObject(const PhysicsCompressionReport& physics) {
  if (physics.tets == 0) return {};
  return {{"tets", physics.tets},
          {"force_steps", physics.forceSteps},
          {"velocity_steps", physics.velocitySteps},
          {"cg_iterations", physics.cgIterations},
          {"max_phi_after_forces_edges", physics.maxPhiAfterForces},
          {"max_phi_edges", physics.maxPhi},
          {"kinetic_energy_share", physics.kineticEnergy},
          {"converged", physics.converged},
          {"nodes_left_behind", physics.leftBehind}};
}

Json toJsonObject(const TissueCompression& compression) {
  return {{"physics", toJsonObject(compression.method.physics)},
          {"tets_beyond_bounds", compression.method.mendedTets},
          {"nodes_mended", compression.method.mendedNodes},
          {"patches_tried", compression.patchesTried},
          {"patches_mended", compression.patchesMended}};
}

Json toJsonObject(const std::vector<std::pair<std::string, PhysicsValue>>& settings) {
  Json object = Json::object();
  for (const auto& [key, value] : settings)
    object[key] = std::visit([](const auto& plain) { return Json(plain); }, value);
  return object;
}

Json toJsonObject(const TissueReport& report) {
  Json seconds = Json::object();
  for (const auto& [stage, time] : report.seconds) seconds[stage] = time;
  Json topology = toJsonObject(report.topology);
  topology["label_components"] = report.smoothing.voxels.components;
  topology["label_cavities"] = report.smoothing.voxels.cavities;
  topology["smoothed_components"] = report.smoothing.levelSet.components;
  topology["smoothed_cavities"] = report.smoothing.levelSet.cavities;
  topology["level_set_components"] = report.levelSetComponents;
  topology["level_set_euler_characteristic"] = report.levelSetEuler;
  return {{"name", report.name},
          {"id", report.id},
          {"label", report.label},
          {"layer", report.layer},
          {"color", report.color},
          {"file", report.file},
          {"combined_label", report.combinedLabel ? Json(*report.combinedLabel) : Json()},
          {"status", toString(report.status)},
          {"message", report.message},
          {"edge_length_mm", report.edgeLength},
          {"min_edge_length_mm", report.minEdgeLength},
          {"seconds", seconds},
          {"tets", report.quality.tets},
          {"nodes", report.quality.nodes},
          {"compression", toJsonObject(report.compression)},
          {"quality", toJsonObject(report.quality)},
          {"worst", toJsonArray(report.worst)},
          {"conditions", toJsonObject(report.conditions)},
          {"topology", topology},
          {"topology_difference_count", report.topologyDifferenceCount},
          {"topology_differences", toJsonArray(report.topologyDifferences)},
          {"fidelity", toJsonObject(report.fidelity)},
          {"lost", toJsonObject(report.lost)},
          {"curved_edges", report.curved ? toJsonObject(*report.curved) : Json()}};
}

Json toJsonObject(const MeshTissuesOptions& options, double voxel) {
  Json sizes = Json::object();
  for (const auto& [wish, length] : options.sizes) sizes[wish] = length.millimetres(voxel);
  Json smoothings = Json::object();
  for (const auto& [wish, smoothing] : options.smoothings) smoothings[wish] = toString(smoothing);
  const double edge = options.edgeLength.millimetres(voxel);
  const double largest = options.maxEdgeLength.millimetres(voxel);
  return {{"edge_length_mm", edge},
          {"max_edge_length_mm", largest > 0 ? largest : 8 * edge},
          {"min_edge_length_mm", options.minEdgeLength.millimetres(voxel)},
          {"sizes_mm", sizes},
          {"target_tets", options.targetTets},
          {"curvature", options.curvature},
          {"tolerance_mm", options.tolerance.millimetres(voxel)},
          {"levels", options.levels},
          {"method", toString(options.method)},
          {"physics", toJsonObject(physicsSettings(options.method, options.physics))},
          {"preserve_volume", options.preserveVolume},
          {"with_quality", options.withQuality},
          {"smoothing", toString(options.smoothing)},
          {"smoothings", smoothings},
          {"band_voxels", options.levelSet.bandVoxels},
          {"thick_slice_ratio", options.levelSet.thickSliceRatio},
          {"grid_spacing_mm", options.levelSet.gridSpacing},
          {"format", options.extension.substr(1)},
          {"space", options.writing.space == Space::Ras ? "RAS" : "LPS"},
          {"space_tag", options.writing.spaceTag},
          {"units_per_mm", options.writing.perMm},
          {"quadratic", options.writing.quadratic}};
}

Json toJsonObject(const VoxelBox& box) {
  const auto corner = [](const Eigen::Vector3i& c) { return Json{c.x(), c.y(), c.z()}; };
  return {{"lower", corner(box.lower)}, {"upper", corner(box.upper)}};
}

/// What the file says of a tissue.
Json tissueFields(const Tissue& tissue) {
  return {{"name", tissue.name},   {"id", tissue.id},       {"label", tissue.label}, {"layer", tissue.layer},
          {"named", tissue.named}, {"color", tissue.color}, {"tags", tissue.tags},   {"keys", tissue.keys}};
}

std::string processorName() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

Json machine() {
  utsname system{};
  uname(&system);
  return {{"processor", processorName()},
          {"processors", std::thread::hardware_concurrency()},
          {"system", std::string(system.sysname) + " " + system.release + " " + system.machine}};
}

std::string document(const Json& json) {
  // Names may be in any encoding: what is not UTF-8 is replaced, not refused.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Json programFields() { return {{"program", "sinew"}, {"version", version()}}; }

}  // namespace

const char* version() { return SINEW_VERSION; }

const char* toString(TissueStatus status) {
  switch (status) {
    case TissueStatus::Meshed:
      return "meshed";
    case TissueStatus::Lost:
      return "lost";
    case TissueStatus::Failed:
      break;
  }
  return "failed";
}

std::string toJson(const MeshingReport& report) {
  Json json = programFields();
  json["input"] = report.input;
  json["options"] = toJsonObject(report.options, report.voxel);
  json["options"]["tissues"] = report.wishes;
  json["machine"] = machine();
  json["threads"] = report.threads;
  json["total_seconds"] = report.seconds;
  json["peak_memory_bytes"] = static_cast<std::int64_t>(report.peakMemory);
  json["combined"] = report.combined;
  json["scene"] = report.scene;
  json["tissues"] = Json::array();
  for (const TissueReport& tissue : report.tissues) json["tissues"].push_back(toJsonObject(tissue));
  return document(json);
}

std::string toJson(const std::vector<MeshAssessment>& meshes) {
  Json json = programFields();
  json["meshes"] = Json::array();
  for (const MeshAssessment& mesh : meshes) {
    Json entry{{"file", mesh.file},
               {"tets", mesh.quality.tets},
               {"nodes", mesh.quality.nodes},
               {"volume_mm3", mesh.quality.volume},
               {"quality", toJsonObject(mesh.quality)},
               {"worst", toJsonArray(mesh.worst)},
               {"histogram", toJsonObject(mesh.histogram)},
               {"conditions", toJsonObject(mesh.conditions)},
               {"topology", toJsonObject(mesh.topology)}};
    if (mesh.fidelity) {
      entry["tissue"] = mesh.tissue;
      entry["fidelity"] = toJsonObject(*mesh.fidelity);
      entry["lost"] = toJsonObject(mesh.lost);
    }
    json["meshes"].push_back(entry);
  }
  return document(json);
}

std::string toJson(const Segmentation& segmentation, const std::vector<std::int64_t>& pieces) {
  const ImageGeometry& geometry = segmentation.geometry;
  Json json = programFields();
  json["input"] = segmentation.source;
  json["size"] = {geometry.size.x(), geometry.size.y(), geometry.size.z()};
  json["spacing_mm"] = toArray(geometry.spacing);
  json["origin_mm"] = toArray(geometry.origin);
  json["direction_columns"] = {toArray(geometry.direction.col(0)), toArray(geometry.direction.col(1)),
                               toArray(geometry.direction.col(2))};
  json["voxel_volume_mm3"] = geometry.voxelVolume();
  json["layers"] = segmentation.layers.size();
  json["tissues"] = Json::array();
  for (std::size_t t = 0; t < segmentation.tissues.size(); ++t) {
    const Tissue& tissue = segmentation.tissues[t];
    Json entry = tissueFields(tissue);
    const auto [lower, upper] = tissueBounds(geometry, tissue);
    entry.update({{"voxels", tissue.voxels},
                  {"volume_mm3", static_cast<double>(tissue.voxels) * geometry.voxelVolume()},
                  {"pieces", pieces[t]},
                  {"box_voxels", toJsonObject(tissue.box)},
                  {"box_mm", {{"lower", toArray(lower)}, {"upper", toArray(upper)}}},
                  {"centroid_mm", toArray(tissueCentroid(segmentation, tissue))}});
    json["tissues"].push_back(entry);
  }
  json["empty_tissues"] = Json::array();
  for (const Tissue& tissue : segmentation.emptyTissues)
    json["empty_tissues"].push_back(tissueFields(tissue));
  json["keys"] = segmentation.keys;
  json["warnings"] = segmentation.warnings;
  return document(json);
}

}  // namespace sinew
