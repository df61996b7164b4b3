#pragma once

#include "sinew/LevelSet/DenseLevelSet.h"
#include "sinew/LevelSet/ShapeMeasures.h"
#include "sinew/Segmentation/Segmentation.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sinew {

/// What a script may use; beyond, it is stopped with a clear line.
struct RepairLimits {
  std::int64_t instructions = 200'000'000;  ///< of Lua's machine
  std::int64_t scriptBytes = 128'000'000;   ///< texts and tables of the script
  std::int64_t shapeBytes = 8'000'000'000;  ///< level sets that it holds at a time
};

/// Called as a script advances: its line, the operation, and a guess of the part done, in [0, 1], which never
/// goes back. May throw to stop the script: repairSegmentation then throws the same exception.
using RepairProgress = std::function<void(int line, const std::string& operation, double done)>;

struct RepairOptions {
  std::string scriptName = "script.lua";  ///< for messages
  std::filesystem::path meshFolder = {};  ///< where the files of `mesh` lie: the script's folder
  std::map<std::string, std::string> settings =
      {};                      ///< globals of the script: numbers, `true`, `false`, texts
  double gridSpacing = 0;      ///< of the level sets, mm; 0: defaultGridSpacing
  double smoothingVoxels = 1;  ///< of labels to level sets, see LevelSetFromLabelsOptions
  double smoothingTime = 0;    ///< of a motion by mean curvature after that, mm^2, see smooth
  /// Only try the script: names, arguments and tissues are resolved, no level set is computed. Measures are
  /// then estimates from voxels and boxes; `components` counts the pieces of a tissue's voxels, and takes any
  /// other shape for one piece.
  bool check = false;
  bool levelSets = false;  ///< keep those of the saved tissues in the result
  RepairLimits limits = {};
  RepairProgress progress = {};
  std::function<void(const std::string& text)> print = {};  ///< receives what the script prints, line by line
};

struct ShapeSummary {
  double volume = 0;  ///< mm^3
  ShapeTopology topology;
};

/// One operation of a script that made a level set.
struct RepairOperation {
  int line = 0;
  std::string operation;
  std::string tissue;                         ///< from which the shape came; empty for a solid
  double seconds = 0;                         ///< wall time
  std::optional<ShapeSummary> before, after;  ///< of its first operand, unless that is a solid; of the result
};

/// A tissue that a script saved.
struct SavedTissue {
  std::string name;
  int layer = 0;
  std::int32_t label = 0;
  std::int64_t voxelsBefore = 0, voxelsAfter = 0;
  std::vector<std::pair<std::string, std::int64_t>> yielded;  ///< voxels that went to another tissue
  std::shared_ptr<const DenseLevelSet> levelSet;              ///< of the shape, before it yielded to others
};

struct RepairResult {
  Segmentation segmentation;  ///< empty with `check`
  std::vector<RepairOperation> operations;
  std::vector<SavedTissue> saved;     ///< in the order of the script
  std::vector<std::string> removed;   ///< names of tissues
  std::vector<std::string> messages;  ///< what a person ought to know, one line each
};

/// Runs a repair script (Lua 5.4 in a sandbox; the README holds the language) on a segmentation. Tissues that
/// the script does not save or remove keep their voxels, unless it gives others priority over them.
/// @throws std::invalid_argument `NAME:LINE: message` for all that is wrong with the script, and what
/// options.progress throws.
/// Cost: that of the script's operations, each in proportion to the crops that it touches. The same result
/// for any number of threads.
RepairResult repairSegmentation(const Segmentation& input, const std::string& script,
                                const RepairOptions& options = {});

}  // namespace sinew
