#include "RepairReport.h"

#include "JsonReport.h"
#include "TextTable.h"

#include <functional>

namespace sinew {
namespace {

Json toObject(const std::optional<ShapeSummary>& summary) {
  if (!summary) return nullptr;
  return {{"volume_mm3", summary->volume},
          {"components", summary->topology.components},
          {"cavities", summary->topology.cavities}};
}

Json toObject(const RepairOperation& operation) {
  return {{"line", operation.line},
          {"operation", operation.operation},
          {"tissue", operation.tissue},
          {"seconds", operation.seconds},
          {"before", toObject(operation.before)},
          {"after", toObject(operation.after)}};
}

Json toObject(const SavedTissue& saved, bool check) {
  Json yielded = Json::object();
  for (const auto& [name, voxels] : saved.yielded) yielded[name] = voxels;
  Json object{{"name", saved.name}, {"voxels_before", saved.voxelsBefore}};
  if (!check)
    object.update({{"label", saved.label},
                   {"layer", saved.layer},
                   {"voxels_after", saved.voxelsAfter},
                   {"yielded", yielded}});
  return object;
}

std::string change(const std::optional<ShapeSummary>& before, const std::optional<ShapeSummary>& after,
                   const std::function<std::string(const ShapeSummary&)>& text) {
  const std::string to = after ? text(*after) : "-";
  return (before ? text(*before) : "-") + " -> " + to;
}

TextTable operationTable(const std::vector<RepairOperation>& operations) {
  TextTable table({{"line"},
                   {"operation", Align::Left},
                   {"tissue", Align::Left},
                   {"seconds"},
                   {"volume, mm^3"},
                   {"pieces"},
                   {"cavities"}});
  for (const RepairOperation& operation : operations) {
    const auto changed = [&](const auto& text) { return change(operation.before, operation.after, text); };
    table.add({std::to_string(operation.line), operation.operation,
               operation.tissue.empty() ? "-" : printable(operation.tissue), fixed(operation.seconds, 2),
               changed([](const ShapeSummary& shape) { return fixed(shape.volume, 1); }),
               changed([](const ShapeSummary& shape) { return std::to_string(shape.topology.components); }),
               changed([](const ShapeSummary& shape) { return std::to_string(shape.topology.cavities); })});
  }
  return table;
}

std::string yieldedText(const SavedTissue& saved) {
  std::string text;
  for (const auto& [name, voxels] : saved.yielded)
    text += (text.empty() ? "" : ", ") + grouped(voxels) + " to " + printable(name);
  return text.empty() ? "-" : text;
}

TextTable savedTable(const RepairResult& result, bool check) {
  if (check) {
    TextTable table({{"would be saved", Align::Left}, {"voxels now"}});
    for (const SavedTissue& saved : result.saved)
      table.add({printable(saved.name), grouped(saved.voxelsBefore)});
    return table;
  }
  TextTable table({{"saved", Align::Left}, {"label"}, {"layer"}, {"voxels"}, {"gave voxels", Align::Left}});
  for (const SavedTissue& saved : result.saved)
    table.add({printable(saved.name), std::to_string(saved.label), std::to_string(saved.layer),
               grouped(saved.voxelsBefore) + " -> " + grouped(saved.voxelsAfter), yieldedText(saved)});
  return table;
}

}  // namespace

std::string toJson(const RepairRun& run, const RepairResult& result) {
  Json json = programFields();
  json.update({{"input", run.input},
               {"script", run.script},
               {"output", run.output},
               {"check", run.check},
               {"total_seconds", run.seconds}});
  json["operations"] = Json::array();
  for (const RepairOperation& operation : result.operations)
    json["operations"].push_back(toObject(operation));
  json["saved"] = Json::array();
  for (const SavedTissue& saved : result.saved) json["saved"].push_back(toObject(saved, run.check));
  json["removed"] = result.removed;
  json["messages"] = result.messages;
  return document(json);
}

void printResult(std::ostream& stream, const RepairRun& run, const RepairResult& result) {
  if (!result.operations.empty()) {
    operationTable(result.operations).print(stream);
    stream << '\n';
  }
  if (!result.saved.empty()) {
    savedTable(result, run.check).print(stream);
    stream << '\n';
  }
  for (const std::string& name : result.removed)
    stream << (run.check ? "would be removed: " : "removed: ") << printable(name) << '\n';
  for (const std::string& message : result.messages) stream << printable(message) << '\n';
  if (run.check)
    stream << run.script << ": nothing wrong was found\n";
  else
    stream << run.output << " in " << fixed(run.seconds, 1) << " s\n";
}

}  // namespace sinew
