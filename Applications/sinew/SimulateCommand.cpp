#include "SimulateCommand.h"

#include "CommandLine.h"
#include "Interrupt.h"
#include "ProgressDisplay.h"
#include "SimulationFiles.h"
#include "commands.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Pipeline/StagedFolder.h"
#include "sinew/Simulation/TrialPlot.h"

#include <algorithm>
#include <chrono>
#include <optional>

namespace sinew {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr int kMostFrames = 9998;
constexpr int kMostWords = 9999;  // after the option of a trial: its amount, and meshes

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// An option that chooses a trial, with the amount of it that may follow.
struct TrialOption {
  Trial trial;
  const char *flag, *form, *help;
};

constexpr std::array kTrialOptions{
    TrialOption{Trial::Contract, "--contract", "[ACTIVATION]", "isometric contraction: the ends are held"},
    TrialOption{Trial::Compress, "--compress", "[STRAIN]",
                "the ends are pushed together, by a share of their distance"},
    TrialOption{Trial::Indent, "--indent", "[SHARE]",
                "a patch is pushed in, by a share of the thickness there"},
    TrialOption{Trial::Stretch, "--stretch", "[STRAIN]",
                "the ends are pulled apart, by a share of their distance"},
    TrialOption{Trial::Twist, "--twist", "[DEG]", "the ends are turned against each other, in degrees"},
};

/// What was chosen on the command line, before it is checked.
struct Choices {
  std::array<std::optional<std::string>, kTrialOptions.size()> trials;  ///< amounts; may be empty texts
  std::vector<std::string> meshes;                                      ///< that follow a trial's option
  std::optional<double> shear, bulk;
};

std::string usualText(Trial trial) { return CLI::detail::to_string(usualAmount(trial)); }

std::optional<double> amountIn(const std::string& text) {
  double amount = 0;
  if (!CLI::detail::lexical_cast(text, amount)) return std::nullopt;
  return amount;
}

void addTrialOptions(CLI::App& app, Choices& choices) {
  for (std::size_t i = 0; i < kTrialOptions.size(); ++i) {
    const TrialOption& row = kTrialOptions[i];
    app.add_option_function<std::vector<std::string>>(
           row.flag,
           [&choices, i](std::vector<std::string> words) {
             std::erase(words, "");  // what the parser gives for no word at all
             const bool hasAmount = !words.empty() && amountIn(words.front());
             choices.trials[i] = hasAmount ? words.front() : std::string();
             choices.meshes.insert(choices.meshes.end(), words.begin() + (hasAmount ? 1 : 0), words.end());
           },
           std::string(row.help) + "; default " + usualText(row.trial))
        ->expected(0, kMostWords)
        ->type_name(row.form);
  }
}

void takeTrial(const Choices& choices, TrialOptions& options) {
  const auto given = [](const std::optional<std::string>& amount) { return amount.has_value(); };
  if (std::ranges::count_if(choices.trials, given) != 1)
    throw CLI::RequiredError("choose one of --contract, --compress, --indent, --stretch and --twist",
                             CLI::ExitCodes::RequiredError);
  const auto index =
      static_cast<std::size_t>(std::ranges::find_if(choices.trials, given) - choices.trials.begin());
  const TrialOption& row = kTrialOptions[index];
  options.trial = row.trial;
  const std::string& text = *choices.trials[index];
  if (text.empty()) return;
  options.amount = amountIn(text);
  try {
    checkTrialOptions({.trial = options.trial, .amount = options.amount});
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(row.flag, error.what());
  }
}

/// Refuses what only a muscle that contracts listens to.
void checkEffects(const CLI::App& app, Trial trial) {
  if (trial == Trial::Contract) return;
  const TrialOption& row = *std::ranges::find(kTrialOptions, trial, &TrialOption::trial);
  for (const char* flag :
       {"--tendon", "--spline", "--tension", "--tendon-shear", "--tendon-bulk", "--tendon-tension"})
    if (app.get_option(flag)->count() > 0)
      throw CLI::ValidationError(flag, std::string("has no effect on ") + row.flag);
}

void checkFrames(int frames) {
  if (frames % 2 != 0 || frames > kMostFrames)
    throw CLI::ValidationError("--frames", std::to_string(frames) + "; it must be an even number up to " +
                                               std::to_string(kMostFrames));
}

/// What the rows of options cannot tell.
void checkTrial(const TrialOptions& options) {
  checkFrames(options.frames);
  try {
    checkTrialOptions(options);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(error.what());
  }
}

void takeMaterial(const Choices& choices, TrialOptions& options) {
  const bool muscle = options.trial == Trial::Contract;
  (muscle ? options.muscle.shear : options.tissue.shear) =
      choices.shear.value_or(muscle ? options.muscle.shear : options.tissue.shear);
  (muscle ? options.muscle.bulk : options.tissue.bulk) =
      choices.bulk.value_or(muscle ? options.muscle.bulk : options.tissue.bulk);
}

std::vector<Option> trialOptions(SimulateCommand& command, Choices& choices) {
  TrialOptions& trial = command.trial;
  const auto pressure = [](const char* flag, auto* target, const char* help) {
    return Option{.flags = flag, .target = target, .help = help, .form = "KPA", .least = 1e-6};
  };
  return {
      {.flags = "--duration",
       .target = &trial.duration,
       .help = "of the way there and back, s",
       .form = "S",
       .least = 1e-6},
      {.flags = "--frames",
       .target = &trial.frames,
       .help = "states after the first, evenly in time; an even number",
       .least = 2},
      {"--no-series", &command.noSeries, "write no mesh for each frame"},
      pressure("--shear", &choices.shear, "shear modulus of the muscle, across its fibres, kPa; default 10"),
      pressure("--bulk", &choices.bulk, "bulk modulus, kPa; default 500 with --contract, else 100"),
      pressure("--tension", &trial.muscle.tension, "largest isometric tension of the fibres, kPa"),
      pressure("--tendon-shear", &trial.muscle.tendonShear, "shear modulus of tendon, kPa"),
      pressure("--tendon-bulk", &trial.muscle.tendonBulk, "bulk modulus of tendon, kPa"),
      pressure("--tendon-tension", &trial.muscle.tendonTension,
               "factor of the passive tension of tendon, kPa"),
  };
}

/// One mesh of a run.
class MeshRun {
 public:
  /// @param done, all  meshes before this one, and of the whole run
  MeshRun(const CommandLine& line, const SimulateCommand& command, SimulatedMesh& mesh,
          ProgressDisplay& display, std::size_t done, std::size_t all)
      : line_(line), command_(command), mesh_(mesh), display_(display), done_(done), all_(all) {}

  TrialReport run(const fs::path& folder, const std::string& stem) {
    const Clock::time_point start = Clock::now();
    show("reading", 0);
    TissueMeshInput input = readTissueMesh(mesh_.file, command_.fibres.tissue);
    const TrialSetup setup = setUp(input);
    const TetMesh rest = input.tissue.mesh;
    std::optional<TrialSeries> series;
    if (!command_.noSeries) series.emplace(folder, stem, std::move(input.tissue), setup.fibres);
    TrialOptions options = command_.trial;
    const std::string stage(trialName(options.trial));
    double frames = 0, steps = 0;  // done; and since the last of them
    options.onStep = [&] {
      checkInterrupt();
      constexpr double kUsualSteps = 4;  // of a frame; its bar creeps on beyond them
      show(stage, std::min(1., (frames - 1 + steps / (steps + kUsualSteps)) / options.frames));
      ++steps;
    };
    const TrialReport report =
        runTrial(rest, setup, options, [&](const TrialFrame& frame, const NodeVectors& places) {
          checkInterrupt();
          show(stage, frame.time / options.duration);
          if (series) series->add(frame.time, places);
          ++frames;
          steps = 0;
        });
    if (series) series->finish();
    mesh_.seconds = secondsSince(start);
    return report;
  }

 private:
  TrialSetup setUp(const TissueMeshInput& input) {
    TrialSetup setup{attachmentsOf(input, command_.fibres), {}, {}};
    if (command_.trial.trial == Trial::Contract) {
      show("fibres", 0);
      TissueFibres fibres = fibresOf(input, setup.attachments, command_.fibres, OwnFibres::Take);
      mesh_.fibres = fibres.source;
      mesh_.tetsOutsideSpline = fibres.outside;
      if (fibres.outside > 0 && !fibres.warning().empty()) line_.warn(mesh_.file + ": " + fibres.warning());
      setup.fibres = std::move(fibres.directions);
      if (fibres.missing > 0) fillLoosePieces(setup.fibres, longAxis(input.tissue.mesh));
      setup.tendons = std::move(fibres.tendons);
    }
    mesh_.tissue = input.tissue.regions.front().name;
    mesh_.tets = std::ssize(input.tissue.mesh.tets);
    mesh_.nodes = std::ssize(input.tissue.mesh.nodes);
    mesh_.originNodes = std::ssize(setup.attachments.origin);
    mesh_.insertionNodes = std::ssize(setup.attachments.insertion);
    return setup;
  }

  /// A small piece that no attachment reaches has no fibres, and does not move: any direction will do.
  static void fillLoosePieces(NodeVectors& fibres, const Eigen::Vector3d& axis) {
    for (Eigen::Vector3d& fibre : fibres)
      if (fibre.isZero()) fibre = axis;
  }

  void show(const std::string& stage, double share) {
    display_.show(mesh_.name, stage, (static_cast<double>(done_) + share) / static_cast<double>(all_));
  }

  const CommandLine& line_;
  const SimulateCommand& command_;
  SimulatedMesh& mesh_;
  ProgressDisplay& display_;
  std::size_t done_, all_;
};

Simulation runTrials(const CommandLine& line, const SimulateCommand& command, const TrialOutputs& names,
                     const std::vector<std::string>& meshNames, const fs::path& folder) {
  Simulation simulation;
  simulation.table = names.table;
  simulation.plot = names.plot;
  ProgressDisplay display(line.common);
  for (std::size_t i = 0; i < command.meshes.size(); ++i) {
    SimulatedMesh mesh{.file = command.meshes[i], .name = meshNames[i], .series = {}, .tissue = {}};
    const std::string& stem = names.stems[i];
    if (!command.noSeries) mesh.series = TrialSeries::listName(stem);
    try {
      TrialReport report = MeshRun(line, command, mesh, display, i, command.meshes.size()).run(folder, stem);
      simulation.trials.push_back({mesh.name, std::move(report)});
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(mesh.file + ": " + error.what());
    }
    simulation.meshes.push_back(std::move(mesh));
  }
  return simulation;
}

std::string plotTitle(const SimulateCommand& command, const Simulation& simulation) {
  constexpr std::array kTitles{"Isometric contraction", "Compression", "Indentation", "Stretch", "Twist"};
  const std::string title = kTitles[static_cast<std::size_t>(command.trial.trial)];
  return simulation.meshes.size() == 1 ? title + " of " + simulation.meshes.front().name : title;
}

/// Completes the command by the choices.
void take(const CommandLine& line, const Choices& choices, SimulateCommand& command) {
  takeTrial(choices, command.trial);
  command.meshes.insert(command.meshes.end(), choices.meshes.begin(), choices.meshes.end());
  takeMaterial(choices, command.trial);
  if (command.meshes.empty()) throw CLI::RequiredError("MESH");
  if (command.meshes.size() > 1 && !command.compare)
    throw CLI::ValidationError(
        "MESH", std::to_string(command.meshes.size()) + " meshes; add --compare to compare them");
  checkEffects(line.app, command.trial.trial);
  checkTrial(command.trial);
  checkFibreSettings(command.fibres);
}

int simulate(const CommandLine& line, SimulateCommand& command, const Choices& choices) {
  const Clock::time_point start = Clock::now();
  take(line, choices, command);
  const std::vector<std::string> meshNames = shortNames(command.meshes);
  const TrialOutputs names = trialOutputs(command, meshNames);
  const std::vector<std::string> older = names.olderIn(command.folder);
  checkOutputFolder(command.folder, older, line.common.force);

  const InterruptScope interruptible;
  StagedFolder folder(command.folder);
  Simulation simulation = runTrials(line, command, names, meshNames, folder.temporary());
  writeTextFile(folder.temporary() / names.table, trialTable(simulation.trials));
  writeTextFile(folder.temporary() / names.plot,
                trialPlot(simulation.trials, command.trial.trial, plotTitle(command, simulation)));
  simulation.seconds = secondsSince(start);
  const std::string report = toJson(command, simulation);
  writeTextFile(folder.temporary() / names.report, report);
  const std::vector<std::string> stale = missingIn(folder.temporary(), older);
  folder.commit();
  for (const std::string& name : stale) fs::remove(fs::path(command.folder) / name);

  line.writeJson(report);
  if (std::ostream* stream = line.tables()) print(*stream, simulation);
  const bool completed =
      std::ranges::all_of(simulation.trials, [](const NamedTrial& trial) { return trial.report.completed; });
  return completed ? 0 : 1;
}

}  // namespace

int runSimulate(const std::vector<std::string>& arguments) {
  CommandLine line(
      "simulate",
      "Contracts, compresses, dents, stretches or twists meshes, and says how their tets bear it.");
  SimulateCommand command;
  Choices choices;
  CLI::App& app = line.app;
  app.add_option("MESH", command.meshes, "meshes: " + meshExtensions(&MeshFormat::readable));
  app.add_option(
         "-o,--output", command.folder,
         "folder for the series of meshes (.pvd, .vtu), the table (.csv), the plot (.svg) and report.json; "
         "made if missing")
      ->type_name("DIR")
      ->required();
  addTrialOptions(app, choices);
  app.add_flag("--compare", command.compare, "the same trial of several meshes, in one plot and a table");
  addOptions(app, fibreOptions(command.fibres));
  addOptions(app, trialOptions(command, choices));
  app.footer(
      "Fibres, for --contract: of --spline, else the mesh's own array fibres, else from origin to "
      "insertion.\n"
      "Exit code 0: every trial is complete; 1: failed, or a trial stopped early (what it did is written).");
  return line.run(arguments, [&] { return simulate(line, command, choices); });
}

}  // namespace sinew
