#include "CommandLine.h"
#include "JsonReport.h"
#include "SimulateCommand.h"
#include "TextTable.h"
#include "sinew/Pipeline/Memory.h"

#include <algorithm>

namespace sinew {
namespace {

Json toJson(const TrialSpot& spot) {
  return {{"tet", spot.tet}, {"place_mm", {spot.place.x(), spot.place.y(), spot.place.z()}}};
}

Json toJson(const SimulatedMesh& mesh, const TrialReport& report) {
  Json json;
  json["file"] = mesh.file;
  json["name"] = mesh.name;
  json["tissue"] = mesh.tissue;
  json["tets"] = mesh.tets;
  json["nodes"] = mesh.nodes;
  json["origin_nodes"] = mesh.originNodes;
  json["insertion_nodes"] = mesh.insertionNodes;
  json["fibres"] = mesh.fibres;
  json["tets_outside_spline"] = mesh.tetsOutsideSpline;
  json["completed"] = report.completed;
  json["stopped_at"] = report.stoppedAt ? Json(*report.stoppedAt) : Json();
  json["verdict"] = report.verdict;
  json["aspect_ratio_at_rest"] = report.frames.front().maxAspectRatio;
  json["max_aspect_ratio"] = report.largestAspectRatio;
  json["aspect_ratio_growth"] = report.growth;
  json["min_volume_ratio"] = report.leastVolumeRatio;
  json["min_dihedral_deg"] = report.leastDihedralDeg;
  json["max_dihedral_deg"] = report.largestDihedralDeg;
  json["worst"] = toJson(report.worst);
  json["loose_pieces"] = report.loosePieces;
  json["loose_tets"] = report.looseTets;
  json["frames"] = report.frames.size();
  json["seconds"] = mesh.seconds;
  json["series"] = mesh.series;
  return json;
}

Json toJson(const FibreSettings& settings) {
  return {{"label", settings.tissue},
          {"origin", settings.origin},
          {"insertion", settings.insertion},
          {"ends", settings.ends},
          {"contact_mm", settings.contact ? Json(*settings.contact) : Json()},
          {"tendon", settings.tendon ? Json(*settings.tendon) : Json()},
          {"spline", settings.spline}};
}

Json toJson(const TrialOptions& options) {
  Json json{{"amount", options.amount.value_or(usualAmount(options.trial))},
            {"duration_s", options.duration},
            {"frames", options.frames}};
  if (options.trial == Trial::Contract) {
    const MuscleOptions& muscle = options.muscle;
    json["muscle"] = {{"shear_kpa", muscle.shear},
                      {"bulk_kpa", muscle.bulk},
                      {"tension_kpa", muscle.tension},
                      {"tendon_shear_kpa", muscle.tendonShear},
                      {"tendon_bulk_kpa", muscle.tendonBulk},
                      {"tendon_tension_kpa", muscle.tendonTension}};
  } else {
    json["tissue"] = {{"shear_kpa", options.tissue.shear}, {"bulk_kpa", options.tissue.bulk}};
  }
  return json;
}

TextTable comparison(const Simulation& simulation) {
  TextTable table({{"mesh, worst first", Align::Left},
                   {"tets"},
                   {"max AR at rest"},
                   {"largest"},
                   {"growth, %"},
                   {"least J"},
                   {"smallest dihedral, deg"},
                   {"seconds"},
                   {"", Align::Left}});
  for (const std::size_t i : worstToBest(simulation.trials)) {
    const TrialReport& report = simulation.trials[i].report;
    const SimulatedMesh& mesh = simulation.meshes[i];
    const TextTable::Cell end{report.completed ? "completed" : "stopped early",
                              report.completed ? Tone::Good : Tone::Bad};
    table.add({printable(mesh.name), grouped(mesh.tets), fixed(report.frames.front().maxAspectRatio, 2),
               fixed(report.largestAspectRatio, 2), signedFixed(100 * report.growth, 1),
               fixed(report.leastVolumeRatio, 3), fixed(report.leastDihedralDeg, 1), fixed(mesh.seconds, 1),
               end});
  }
  return table;
}

}  // namespace

std::string toJson(const SimulateCommand& command, const Simulation& simulation) {
  Json json = programFields();
  json["trial"] = trialName(command.trial.trial);
  json["options"] = toJson(command.trial);
  json["options"]["ends_and_fibres"] = toJson(command.fibres);
  json["threads"] = threadCount();
  json["total_seconds"] = simulation.seconds;
  json["peak_memory_bytes"] = static_cast<std::int64_t>(peakMemory());
  json["table"] = simulation.table;
  json["plot"] = simulation.plot;
  json["meshes"] = Json::array();
  for (std::size_t i = 0; i < simulation.meshes.size(); ++i)
    json["meshes"].push_back(toJson(simulation.meshes[i], simulation.trials[i].report));
  json["worst_to_best"] = Json::array();
  for (const std::size_t i : worstToBest(simulation.trials))
    json["worst_to_best"].push_back(simulation.meshes[i].name);
  return document(json);
}

void print(std::ostream& stream, const Simulation& simulation) {
  for (const NamedTrial& trial : simulation.trials)
    stream << printable(trial.name) << ": " << trial.report.verdict << '\n';
  if (simulation.trials.size() < 2) return;
  stream << '\n';
  comparison(simulation).print(stream);
}

}  // namespace sinew
