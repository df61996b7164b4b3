#include "ConvertCommand.h"
#include "JsonReport.h"
#include "TextTable.h"
#include "sinew/Pipeline/OutputFile.h"
#include "sinew/Segmentation/KeepTissues.h"
#include "sinew/Segmentation/SelectTissues.h"
#include "sinew/Segmentation/WriteLabelMap.h"
#include "sinew/Segmentation/WriteLabelTable.h"
#include "sinew/Segmentation/WriteSegmentation.h"

#include <iostream>

namespace sinew {
namespace {

namespace fs = std::filesystem;

bool isSlicerSegmentation(const std::string& file) { return file.ends_with(".seg.nrrd"); }

/// A label map's name without what the formats append to it: `knee` of `knee.nii.gz`.
std::string stemOf(const std::string& file) {
  for (const std::string_view ending : {".nii.gz", ".nii", ".nrrd", ".mha", ".mhd"})
    if (file.ends_with(ending)) return file.substr(0, file.size() - ending.size());
  return file;
}

/// The tables to write: those asked for, or else one beside a label map, whose names would be lost.
std::vector<std::string> tablesOf(const ConvertCommand& command) {
  if (!command.tables.empty()) return command.tables;
  if (command.noTable || isSlicerSegmentation(command.output)) return {};
  const std::string stem = stemOf(command.output);
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

LabelMapReport write(const Segmentation& segmentation, const ConvertCommand& command, const fs::path& file) {
  if (!isSlicerSegmentation(command.output)) return writeLabelMap(segmentation, file, merging(command));
  writeSegmentation(segmentation, file);
  LabelMapReport report;
  report.table = labelTable(segmentation);
  return report;
}

/// The map and its tables; all get their names when all are complete.
LabelMapReport writeAll(const Segmentation& segmentation, const ConvertCommand& command,
                        const std::vector<std::string>& tables) {
  const OutputFolder folder(fs::absolute(command.output).parent_path());
  OutputFile output(command.output);
  LabelMapReport report = write(segmentation, command, output.temporary());
  for (const std::string& table : tables) {
    OutputFile file(table);
    writeLabelTable(report.table, file.temporary());
    file.commit();
  }
  output.commit();
  return report;
}

void print(std::ostream& stream, const ConvertCommand& command, const Segmentation& segmentation,
           const LabelMapReport& report, const std::vector<std::string>& tables) {
  for (const LabelChange& change : report.changes)
    stream << printable(change.name) << " of layer " << change.layer << ": label " << change.from
           << " is another tissue's, so it became " << change.to << '\n';
  if (report.contestedVoxels > 0)
    stream << grouped(report.contestedVoxels)
           << " voxels belong to several tissues; the first one kept them\n";
  stream << command.output << ": " << segmentation.tissues.size() << " tissues\n";
  for (const std::string& table : tables) stream << table << ": their names and colours\n";
}

Json toJson(const ConvertCommand& command, const Segmentation& segmentation, const LabelMapReport& report,
            const std::vector<std::string>& tables) {
  Json json = programFields();
  json["kind"] = "segmentation";
  json["inputs"] = command.inputs;
  json["output"] = command.output;
  json["tables"] = tables;
  json["tissues"] = Json::array();
  for (const Tissue& tissue : segmentation.tissues)
    json["tissues"].push_back(
        {{"name", tissue.name}, {"label", tissue.label}, {"layer", tissue.layer}, {"voxels", tissue.voxels}});
  json["label_changes"] = Json::array();
  for (const LabelChange& change : report.changes)
    json["label_changes"].push_back(
        {{"name", change.name}, {"layer", change.layer}, {"from", change.from}, {"to", change.to}});
  json["contested_voxels"] = report.contestedVoxels;
  return json;
}

}  // namespace

std::string convertSegmentation(const CommandLine& line, const ConvertCommand& command) {
  const std::vector<std::string> tables = tablesOf(command);
  check(line, command, tables);
  const Segmentation segmentation = readInput(command);
  line.printWarnings(segmentation);
  const LabelMapReport report = writeAll(segmentation, command, tables);
  if (std::ostream* stream = line.tables()) print(*stream, command, segmentation, report, tables);
  return document(toJson(command, segmentation, report, tables));
}

}  // namespace sinew
