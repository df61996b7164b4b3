#include "sinew/Repair/RepairSegmentation.h"

#include "AssembleLabels.h"
#include "ComputingEngine.h"
#include "SavedVoxels.h"
#include "Session.h"
#include "sinew/Segmentation/NearestNames.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sinew {
namespace {

using namespace repair;

/// Every name with priority is a tissue of the input or a saved one.
void checkPriority(const Session& session) {
  std::vector<std::string> names;
  for (const Tissue& tissue : session.input().tissues) names.push_back(tissue.name);
  for (const Saving& saving : session.wishes.savings) names.push_back(saving.name);
  for (const std::string& name : session.wishes.priority)
    if (std::ranges::find(names, name) == names.end())
      throw std::invalid_argument(session.options().scriptName + ":" +
                                  std::to_string(session.wishes.priorityLine) + ": priority: no tissue " +
                                  quoted(name) + "; the nearest names are " + nearestNames(name, names));
}

void run(Sandbox& sandbox, Session& session, const std::string& script) {
  sandbox.run(script);
  checkPriority(session);
  session.tellUnusedSettings();
}

SandboxOptions sandboxOptions(const RepairOptions& options) {
  return {options.scriptName, options.limits.instructions, options.limits.scriptBytes};
}

RepairResult resultOf(Session& session) {
  RepairResult result;
  result.operations = std::move(session.operations);
  result.messages = std::move(session.messages);
  for (const int t : session.wishes.removed)
    result.removed.push_back(session.input().tissues[static_cast<std::size_t>(t)].name);
  for (const Saving& saving : session.wishes.savings) {
    SavedTissue saved;
    saved.name = saving.name;
    if (saving.tissue >= 0) {
      const Tissue& tissue = session.input().tissues[static_cast<std::size_t>(saving.tissue)];
      saved.layer = tissue.layer;
      saved.label = tissue.label;
      saved.voxelsBefore = tissue.voxels;
    }
    result.saved.push_back(std::move(saved));
  }
  return result;
}

RepairResult checked(const Segmentation& input, const std::string& script, const RepairOptions& options) {
  Session session(input, script, options, makeEstimatingEngine(input));
  Sandbox sandbox(allBindings(), session, sandboxOptions(options));
  run(sandbox, session, script);
  return resultOf(session);
}

/// What `make` makes of a saved shape; what goes wrong is told with the line that saved it.
template <class Make>
auto ofSaving(const Session& session, const Saving& saving, const Make& make) try {
  return make();
} catch (const ScriptStopped&) {
  throw;
} catch (const std::bad_alloc&) {
  throw;
} catch (const std::exception& error) {
  throw std::invalid_argument(session.options().scriptName + ":" + std::to_string(saving.line) + ": save " +
                              quoted(saving.name, '"') + ": " + error.what());
}

/// An input with overlaps keeps them, unless the script says which tissue wins.
LabelWishes labelWishes(const Session& session, ComputingEngine& engine) {
  const Wishes& wishes = session.wishes;
  LabelWishes labels;
  labels.removed = wishes.removed;
  labels.priority = wishes.priority;
  labels.layers = wishes.layers || (session.input().layers.size() > 1 && wishes.priority.empty());
  for (const Saving& saving : wishes.savings)
    labels.claims.push_back({saving.name, saving.tissue, saving.color, ofSaving(session, saving, [&] {
                               return savedVoxels(session.input(), saving, engine);
                             })});
  return labels;
}

void addLabels(RepairResult& result, AssembledLabels assembled) {
  for (std::size_t n = 0; n < result.saved.size(); ++n) {
    ClaimResult& claim = assembled.claims[n];
    SavedTissue& saved = result.saved[n];
    saved.layer = claim.layer;
    saved.label = claim.label;
    saved.voxelsBefore = claim.voxelsBefore;
    saved.voxelsAfter = claim.voxelsAfter;
    saved.yielded = std::move(claim.yielded);
    if (saved.voxelsAfter == 0) result.messages.push_back("'" + saved.name + "' is saved without a voxel");
  }
  for (const AssembledLabels::Loss& loss : assembled.losses)
    result.messages.push_back("'" + loss.loser + "' gave " + std::to_string(loss.voxels) + " voxels to '" +
                              loss.winner + "', which has priority");
  result.segmentation = std::move(assembled.segmentation);
}

RepairResult computed(const Segmentation& input, const std::string& script, const RepairOptions& options) {
  auto owned = std::make_unique<ComputingEngine>(input, options);
  ComputingEngine& engine = *owned;
  Session session(input, script, options, std::move(owned));
  Sandbox sandbox(allBindings(), session, sandboxOptions(options));
  engine.setCollector([&] { sandbox.collect(); });
  run(sandbox, session, script);
  RepairResult result = resultOf(session);
  addLabels(result, assembleLabels(input, labelWishes(session, engine)));
  if (options.levelSets)
    for (std::size_t n = 0; n < result.saved.size(); ++n) {
      const Saving& saving = session.wishes.savings[n];
      result.saved[n].levelSet = ofSaving(session, saving, [&] { return engine.distanceOf(saving.shape); });
    }
  return result;
}

}  // namespace

RepairResult repairSegmentation(const Segmentation& input, const std::string& script,
                                const RepairOptions& options) {
  if (!(options.gridSpacing >= 0) || !std::isfinite(options.gridSpacing))
    throw std::invalid_argument("repairSegmentation: the grid spacing is " + toText(options.gridSpacing) +
                                " mm; allowed: 0 and above");
  return options.check ? checked(input, script, options) : computed(input, script, options);
}

}  // namespace sinew
