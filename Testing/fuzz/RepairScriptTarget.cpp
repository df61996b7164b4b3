#include "Laws.h"
#include "SoundSegmentation.h"
#include "Targets.h"
#include "sinew/Repair/RepairSegmentation.h"

namespace sinew::fuzz {
namespace {

/// 12^3 voxels of 1 mm: `humerus` (1) and `biceps` (2) beside it, `speckle` (3).
Segmentation smallArm() {
  Segmentation arm;
  arm.source = "arm.nrrd";
  arm.geometry.size.setConstant(12);
  arm.layers.assign(1, std::vector<std::int32_t>(12 * 12 * 12, 0));
  const auto fill = [&](std::int32_t label, const Eigen::Vector3i& lower, const Eigen::Vector3i& upper) {
    for (int k = lower.z(); k < upper.z(); ++k)
      for (int j = lower.y(); j < upper.y(); ++j)
        for (int i = lower.x(); i < upper.x(); ++i) arm.layers[0][i + 12 * (j + 12 * k)] = label;
  };
  fill(1, {2, 3, 1}, {5, 7, 11});
  fill(2, {6, 3, 3}, {10, 8, 9});
  fill(3, {10, 10, 10}, {11, 11, 11});
  for (const auto& [label, name] : {std::pair(1, "humerus"), {2, "biceps"}, {3, "speckle"}}) {
    Tissue& tissue = arm.tissues.emplace_back();
    tissue.name = tissue.id = name;
    tissue.label = label;
    tissue.named = true;
  }
  updateTissueTable(arm);
  return arm;
}

/// What scripts read by `mesh "tet.stl"`.
std::filesystem::path folderWithMesh() {
  test::writeBytes(
      folder() / "tet.stl",
      "solid tet\nfacet\nvertex 2 2 2\nvertex 2 8 2\nvertex 8 2 2\nendfacet\nfacet\nvertex 2 2 2\n"
      "vertex 8 2 2\nvertex 2 2 8\nendfacet\nfacet\nvertex 2 2 2\nvertex 2 2 8\nvertex 2 8 2\n"
      "endfacet\nfacet\nvertex 8 2 2\nvertex 2 8 2\nvertex 2 2 8\nendfacet\nendsolid\n");
  return folder().path();
}

/// Small, so that a script that is stopped by a limit takes no time.
RepairOptions options() {
  static const std::filesystem::path meshes = folderWithMesh();
  RepairOptions options{.meshFolder = meshes};
  options.limits = {.instructions = 200'000, .scriptBytes = 4'000'000, .shapeBytes = 4'000'000};
  return options;
}

void requireMessage(const std::string& message) {
  require(message.starts_with("script.lua:"), "a message does not name the script: " + message);
  require(message.find('\n') == message.npos, "a message has more than one line: " + message);
}

bool tryScript(const Segmentation& arm, const std::string& script) try {
  RepairOptions check = options();
  check.check = true;
  repairSegmentation(arm, script, check);
  return true;
} catch (const std::invalid_argument& error) {
  requireMessage(error.what());
  return false;
}

bool runScript(const Segmentation& arm, const std::string& script) try {
  RepairOptions run = options();
  double before = 0;
  run.progress = [&](int, const std::string&, double done) {
    require(done >= before && done <= 1, "progress goes back, or too far");
    before = done;
  };
  const RepairResult result = repairSegmentation(arm, script, run);
  require(result.segmentation.geometry.size == arm.geometry.size, "a script changes the size of the scan");
  requireSound(result.segmentation);
  return true;
} catch (const std::invalid_argument& error) {
  requireMessage(error.what());
  return false;
}

}  // namespace

bool runRepairScript(std::string_view bytes) {
  static const Segmentation arm = smallArm();
  const std::string script(bytes);
  return tryScript(arm, script) && runScript(arm, script);
}

}  // namespace sinew::fuzz
