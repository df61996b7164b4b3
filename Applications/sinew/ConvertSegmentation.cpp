#include "ConvertCommand.h"
#include "JsonReport.h"
#include "TextTable.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Segmentation/KeepTissues.h"
#include "sinew/Segmentation/MergeLayers.h"
#include "sinew/Segmentation/SelectTissues.h"
#include "sinew/Segmentation/WriteLabelMap.h"
#include "sinew/Segmentation/WriteLabelTable.h"
#include "sinew/Segmentation/WriteSegmentation.h"

#include <algorithm>
#include <iostream>
#include <map>

namespace sinew {
namespace {

namespace fs = std::filesystem;

bool isSlicerSegmentation(const std::string& file) { return file.ends_with(".seg.nrrd"); }

/// A label map's name without what the formats append to it: `knee` of `knee.nii.gz`.
std::string labelMapStem(const std::string& file) {
  for (const std::string_view ending : {".nii.gz", ".nii", ".nrrd", ".mha", ".mhd"})
    if (file.ends_with(ending)) return file.substr(0, file.size() - ending.size());
  return file;
}

/// The tables to write: those asked for, or else one beside a label map, whose names would be lost.
std::vector<std::string> tablesOf(const ConvertCommand& command) {
  if (!command.tables.empty()) return command.tables;
  if (command.noTable || isSlicerSegmentation(command.output)) return {};
  const std::string stem = labelMapStem(command.output);
  return {stem + (stem.ends_with("_dseg") ? ".tsv" : ".ctbl")};
}

/// Everything that can be wrong without reading the input.
void check(const CommandLine& line, const ConvertCommand& command, const std::vector<std::string>& tables) {
  if (command.inputs.size() > 1)
    throw CLI::ValidationError("INPUT", "segmentations are converted one by one, and these are " +
                                            std::to_string(command.inputs.size()));
  if (!isSlicerSegmentation(command.output) && !isLabelMapName(command.output))
    throw CLI::ValidationError("OUT", command.output +
                                          ": a segmentation is written as .seg.nrrd, .nrrd, .nii, .nii.gz or "
                                          ".mha; `sinew mesh` makes meshes");
  checkOutputFile(command.output, line.common.force);
  for (const std::string& table : tables) {
    if (!isLabelTableName(table))
      throw CLI::ValidationError("--table", table + ": tables are written as .ctbl, .csv or .tsv");
    checkOutputFile(table, line.common.force);
  }
}

Segmentation readInput(const ConvertCommand& command) {
  Segmentation segmentation = readSegmentation(command.inputs.front(), command.reading);
  if (!command.tissues.empty()) keepTissues(segmentation, selectTissues(segmentation, command.tissues));
  return segmentation;
}

MergeLayersOptions merging(const ConvertCommand& command) {
  if (!command.priority.empty()) return {command.priority};
  if (command.overlap == "first") return {std::vector<std::string>{}};
  return {};
}

/// A segmentation as it is in the file, and what the one layer of a label map could not hold.
struct Layered {
  Segmentation segmentation;
  std::vector<LabelChange> changes;  ///< labels that several layers used, and their new values
  std::int64_t contestedVoxels = 0;  ///< that several tissues claimed, and one of them kept
  std::vector<std::string> lost;     ///< tissues without a voxel of their own left
};

std::vector<std::string> lostTissues(const Segmentation& before, const MergedLayers& merged) {
  std::map<std::pair<int, std::int32_t>, std::int32_t> newLabels;
  for (const LabelChange& change : merged.changes) newLabels[{change.layer, change.from}] = change.to;
  std::vector<std::string> lost;
  for (const Tissue& tissue : before.tissues) {
    const auto changed = newLabels.find({tissue.layer, tissue.label});
    const std::int32_t label = changed == newLabels.end() ? tissue.label : changed->second;
    if (std::ranges::count(merged.segmentation.tissues, label, &Tissue::label) == 0)
      lost.push_back(tissue.name);
  }
  return lost;
}

Layered inLayersOf(const ConvertCommand& command, Segmentation segmentation) {
  if (isSlicerSegmentation(command.output) || segmentation.layers.size() < 2)
    return {.segmentation = std::move(segmentation), .changes = {}, .lost = {}};
  MergedLayers merged = mergeLayers(segmentation, merging(command));
  std::vector<std::string> lost = lostTissues(segmentation, merged);
  return {std::move(merged.segmentation), std::move(merged.changes), merged.contestedVoxels, std::move(lost)};
}

std::string lossWarning(const ConvertCommand& command, const std::vector<std::string>& lost) {
  if (lost.empty()) return {};
  std::string names;
  for (const std::string& name : lost) names.append(names.empty() ? "'" : ", '").append(name).append("'");
  return command.output + ": no voxel is left of " + names +
         ": others that overlap come first; write a .seg.nrrd, or change --priority";
}

/// The map and its tables; all get their names when all are complete.
void writeAll(const Segmentation& segmentation, const ConvertCommand& command,
              const std::vector<std::string>& tables) {
  const OutputFolder folder(fs::absolute(command.output).parent_path());
  OutputFile output(command.output);
  if (isSlicerSegmentation(command.output))
    writeSegmentation(segmentation, output.temporary());
  else
    writeLabelMap(segmentation, output.temporary());
  for (const std::string& table : tables) {
    OutputFile file(table);
    writeLabelTable(labelTable(segmentation), file.temporary());
    file.commit();
  }
  output.commit();
}

void print(std::ostream& stream, const ConvertCommand& command, const Layered& written,
           const std::vector<std::string>& tables) {
  for (const LabelChange& change : written.changes)
    stream << printable(change.name) << " of layer " << change.layer << ": label " << change.from
           << " is another tissue's, so it became " << change.to << '\n';
  if (written.contestedVoxels > 0)
    stream << grouped(written.contestedVoxels)
           << " voxels belong to several tissues; the first one kept them\n";
  stream << command.output << ": " << written.segmentation.tissues.size() << " tissues\n";
  for (const std::string& table : tables) stream << table << ": their names and colours\n";
}

Json toJson(const ConvertCommand& command, const Layered& written, const std::vector<std::string>& tables) {
  Json json = programFields();
  json["kind"] = "segmentation";
  json["inputs"] = command.inputs;
  json["output"] = command.output;
  json["tables"] = tables;
  json["tissues"] = Json::array();
  for (const Tissue& tissue : written.segmentation.tissues)
    json["tissues"].push_back(
        {{"name", tissue.name}, {"label", tissue.label}, {"layer", tissue.layer}, {"voxels", tissue.voxels}});
  json["label_changes"] = Json::array();
  for (const LabelChange& change : written.changes)
    json["label_changes"].push_back(
        {{"name", change.name}, {"layer", change.layer}, {"from", change.from}, {"to", change.to}});
  json["contested_voxels"] = written.contestedVoxels;
  json["lost_tissues"] = written.lost;
  return json;
}

}  // namespace

std::string convertSegmentation(const CommandLine& line, const ConvertCommand& command) {
  const std::vector<std::string> tables = tablesOf(command);
  check(line, command, tables);
  Segmentation segmentation = readInput(command);
  line.printWarnings(segmentation);
  const Layered written = inLayersOf(command, std::move(segmentation));
  writeAll(written.segmentation, command, tables);
  line.warn(lossWarning(command, written.lost));
  if (std::ostream* stream = line.tables()) print(*stream, command, written, tables);
  return document(toJson(command, written, tables));
}

}  // namespace sinew
