// Slicer module: changes the tissues of a segmentation by a script.
#include "Interrupt.h"
#include "Module.h"
#include "Process.h"
#include "RepairSettings.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Segmentation/WriteSegmentation.h"

namespace sinew {
namespace {

constexpr double kRepairShare = 0.95;  // of the time; the rest writes the segmentation

struct Repair {
  std::string input, output;
  int threads = 0;
  RepairSettings settings;
  std::int64_t saved = 0, removed = 0;  ///< results
};

ModuleGroup filesGroup(Repair& repair) {
  using Channel = ModuleParameter::Channel;
  return {"Input and output",
          "",
          false,
          {inputParameter(repair.input),
           {{"script", &repair.settings.script, "repair script in Lua"},
            "file",
            {{"fileExtensions", ".lua"}},
            "Script",
            Channel::Input},
           {{"output-segmentation", &repair.output, "segmentation to write"},
            "image",
            {{"type", "label"}, {"fileExtensions", ".seg.nrrd"}},
            "Repaired segmentation",
            Channel::Output}}};
}

ModuleDescription describe(Repair& repair) {
  ModuleGroup script{"Script", "Lengths are mm, or voxels with the suffix vox.", true,
                     asParameters(repairOptions(repair.settings))};
  script.parameters.push_back(threadsParameter(repair.threads));
  ModuleGroup results{"Results",
                      "",
                      false,
                      {resultParameter("tissues-saved", repair.saved, "tissues that the script saved"),
                       resultParameter("tissues-removed", repair.removed, "tissues that it removed")}};
  return {"SinewRepair",
          "Sinew Repair",
          "Segmentation.Sinew",
          "Changes the tissues of a segmentation by a script: smooths, combines, fills, rebuilds.",
          {filesGroup(repair), std::move(script), std::move(results)}};
}

void run(Repair& repair, ModuleProgress& progress) {
  const ThreadLimit limit(repair.threads);
  const std::string script = readScript(repair.settings.script);
  const Segmentation input = readSegmentation(repair.input, repair.settings.reading);
  RepairOptions options = resolved(repair.settings, input);
  options.progress = [&](int line, const std::string& operation, double done) {
    checkInterrupt();
    progress.show(kRepairShare * done, "line " + std::to_string(line) + ": " + operation);
  };
  options.print = [&](const std::string& text) { progress.say(text); };

  const InterruptScope interruptible;
  const RepairResult result = repairSegmentation(input, script, options);
  for (const std::string& message : result.messages) progress.say(message);
  repair.saved = std::ssize(result.saved);
  repair.removed = std::ssize(result.removed);
  progress.show(kRepairShare, "writing");
  OutputFile output(repair.output);
  writeSegmentation(result.segmentation, output.temporary());
  output.commit();
}

}  // namespace
}  // namespace sinew

int main(int argc, char** argv) {
  sinew::Repair repair;
  return sinew::runModule(argc, argv, sinew::describe(repair),
                          [&](sinew::ModuleProgress& progress) { sinew::run(repair, progress); });
}
