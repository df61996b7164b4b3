#include "sinew/Pipeline/Report.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sinew {
namespace {

using Json = nlohmann::json;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& item : object.items()) names.push_back(item.key());
  return names;  // in alphabetical order, as nlohmann::json keeps them
}

MeshingReport exampleRun() {
  MeshingReport run;
  run.input = "arm.nrrd";
  run.voxel = 0.5;
  run.options.sizes["skin"] = Length::voxels(4);
  run.options.targetTets = 5000;
  run.options.tolerance = 0.1;
  run.options.minEdgeLength = Length::voxels(0.5);
  run.options.preserveVolume = true;
  run.threads = 3;
  run.seconds = 1.5;
  run.peakMemory = 1e6;
  TissueReport tissue;
  tissue.name = "Fémur \xff";  // damaged UTF-8
  tissue.label = 4;
  tissue.file = "femur.vtu";
  tissue.status = TissueStatus::Meshed;
  tissue.seconds = {{"level set", 0.25}, {"lattice", 0.5}};
  tissue.quality.tets = 12;
  tissue.quality.maxAspectRatio = 2.5;
  tissue.conditions.nonmanifoldEdges = 6;
  tissue.levelSetEuler = 2;
  tissue.fidelity.dice = 0.75;
  tissue.lost = {2, 3.5};
  tissue.topologyDifferenceCount = 21;
  tissue.topologyDifferences = {{TopologyChange::HoleClosed, {1, 2, 3}, 0.5, -2, 0.25, "too coarse"}};
  tissue.worst = {{"aspect_ratio", 7, 2.5, {1, 2, 3}}};
  run.tissues = {tissue, {}};
  return run;
}

TEST(Report, HasTheFieldsThatReadersExpect) {
  const Json json = Json::parse(toJson(exampleRun()));
  EXPECT_EQ(keys(json),
            (std::vector<std::string>{"combined", "input", "machine", "options", "peak_memory_bytes",
                                      "program", "scene", "threads", "tissues", "total_seconds", "version"}));
  const Json& tissue = json["tissues"][0];
  EXPECT_EQ(keys(tissue), (std::vector<std::string>{"color",
                                                    "combined_label",
                                                    "compression",
                                                    "conditions",
                                                    "curved_edges",
                                                    "edge_length_mm",
                                                    "fidelity",
                                                    "file",
                                                    "id",
                                                    "label",
                                                    "layer",
                                                    "lost",
                                                    "message",
                                                    "min_edge_length_mm",
                                                    "name",
                                                    "nodes",
                                                    "quality",
                                                    "seconds",
                                                    "status",
                                                    "tets",
                                                    "topology",
                                                    "topology_difference_count",
                                                    "topology_differences",
                                                    "worst"}));
  EXPECT_EQ(keys(tissue["quality"]),
            (std::vector<std::string>{"inverted", "max_aspect_ratio", "max_dihedral_deg", "max_over_min_edge",
                                      "mean_aspect_ratio", "min_dihedral_deg"}));
  EXPECT_EQ(keys(tissue["conditions"]),
            (std::vector<std::string>{"faces_of_many_tets", "interior_edges_between_boundary_nodes",
                                      "interior_faces_with_three_boundary_nodes", "nonmanifold_edges",
                                      "nonmanifold_nodes", "tets_with_four_boundary_nodes"}));
  EXPECT_EQ(keys(tissue["fidelity"]),
            (std::vector<std::string>{"dice", "label_volume_mm3", "level_set_volume_mm3",
                                      "max_boundary_phi_mm", "surface_max_mm", "surface_max_place_mm",
                                      "surface_offset_mm", "surface_rms_mm", "volume_mm3"}));
  EXPECT_EQ(keys(tissue["lost"]), (std::vector<std::string>{"components", "volume_mm3"}));
}

TEST(Report, CarriesTheValues) {
  const Json json = Json::parse(toJson(exampleRun()));
  EXPECT_EQ(json["program"], "sinew");
  EXPECT_EQ(json["version"], version());
  EXPECT_EQ(json["options"]["edge_length_mm"], 1.0) << "2vox of 0.5 mm";
  EXPECT_EQ(json["options"]["max_edge_length_mm"], 8.0);
  EXPECT_EQ(json["options"]["sizes_mm"]["skin"], 2.0);
  EXPECT_EQ(json["options"]["min_edge_length_mm"], 0.25);
  EXPECT_EQ(json["options"]["target_tets"], 5000);
  EXPECT_EQ(json["options"]["tolerance_mm"], 0.1);
  EXPECT_EQ(json["options"]["preserve_volume"], true);
  EXPECT_EQ(json["options"]["with_quality"], false);
  EXPECT_EQ(json["threads"], 3);
  EXPECT_EQ(json["peak_memory_bytes"], 1000000);
  const Json& tissue = json["tissues"][0];
  EXPECT_EQ(tissue["status"], "meshed");
  EXPECT_EQ(tissue["seconds"]["lattice"], 0.5);
  EXPECT_EQ(tissue["tets"], 12);
  EXPECT_EQ(tissue["quality"]["max_aspect_ratio"], 2.5);
  EXPECT_EQ(tissue["topology_difference_count"], 21);
  EXPECT_EQ(tissue["topology_differences"],
            Json::parse(R"([{"change": "hole closed", "place_mm": [1.0, 2.0, 3.0], "width_mm": 0.5,
                             "euler_characteristic": -2, "volume_mm3": 0.25, "reason": "too coarse"}])"));
  EXPECT_EQ(tissue["worst"], Json::parse(R"([{"measure": "aspect_ratio", "element": 7, "value": 2.5,
                                              "place_mm": [1.0, 2.0, 3.0]}])"));
  EXPECT_EQ(tissue["conditions"]["nonmanifold_edges"], 6);
  EXPECT_EQ(tissue["topology"]["level_set_euler_characteristic"], 2);
  EXPECT_EQ(tissue["fidelity"]["dice"], 0.75);
  EXPECT_EQ(tissue["lost"]["components"], 2);
  EXPECT_EQ(tissue["lost"]["volume_mm3"], 3.5);
  EXPECT_EQ(json["tissues"][1]["status"], "failed");
}

TEST(Report, StatusHasThreeWords) {
  EXPECT_STREQ(toString(TissueStatus::Meshed), "meshed");
  EXPECT_STREQ(toString(TissueStatus::Lost), "lost");
  EXPECT_STREQ(toString(TissueStatus::Failed), "failed");
}

TEST(Report, MeshesHaveFidelityOnlyWithAReference) {
  MeshAssessment plain, compared;
  plain.file = "a.vtu";
  plain.histogram.dihedrals[6] = 12;
  plain.histogram.aspectRatios[1] = 3;
  compared.fidelity = Fidelity{};
  compared.tissue = "skin";
  const Json json = Json::parse(toJson({plain, compared}));
  EXPECT_EQ(json["meshes"][0]["file"], "a.vtu");
  const Json& dihedrals = json["meshes"][0]["histogram"]["dihedral_deg"];
  EXPECT_EQ(dihedrals["from"].size(), 18u);
  EXPECT_EQ(dihedrals["from"][17], 170.0);
  EXPECT_EQ(dihedrals["counts"][6], 12);
  const Json& aspectRatios = json["meshes"][0]["histogram"]["aspect_ratio"];
  EXPECT_EQ(aspectRatios["from"].size(), aspectRatios["counts"].size());
  EXPECT_EQ(aspectRatios["counts"][1], 3);
  EXPECT_FALSE(json["meshes"][0].contains("fidelity"));
  EXPECT_EQ(json["meshes"][1]["tissue"], "skin");
  EXPECT_TRUE(json["meshes"][1].contains("fidelity"));
}

TEST(Report, SegmentationsListTheirTissues) {
  Segmentation segmentation;
  segmentation.geometry.size = {2, 1, 1};
  segmentation.geometry.spacing = {1, 2, 3};
  segmentation.layers = {{0, 8}};
  updateTissueTable(segmentation);
  const Json json = Json::parse(toJson(segmentation, {1}));
  EXPECT_EQ(json["size"], (Json{2, 1, 1}));
  EXPECT_EQ(json["spacing_mm"], (Json{1., 2., 3.}));
  EXPECT_EQ(json["voxel_volume_mm3"], 6.0);
  ASSERT_EQ(json["tissues"].size(), 1u);
  EXPECT_EQ(json["tissues"][0]["label"], 8);
  EXPECT_EQ(json["tissues"][0]["volume_mm3"], 6.0);
  EXPECT_EQ(json["tissues"][0]["pieces"], 1);
}

}  // namespace
}  // namespace sinew
