#include "CommandLine.h"
#include "JsonReport.h"
#include "MeshFileSettings.h"
#include "TextTable.h"
#include "TissueFibres.h"
#include "commands.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/Pipeline/OutputFile.h"

#include <iostream>

namespace sinew {
namespace {

struct FibresCommand {
  std::string mesh, output;
  FibreSettings settings;
  MeshFileSettings files;
};

void checkOutput(const FibresCommand& command, bool force) {
  const MeshFormat* format = findMeshFormat(std::filesystem::path(command.output).filename().string());
  if (format == nullptr || !format->arrays)
    throw CLI::ValidationError(
        "--output", command.output + ": fibres are written as " + meshExtensions(&MeshFormat::arrays));
  checkOutputFile(command.output, force);
}

/// 1 at the origin, 2 at the insertion, 0 elsewhere.
std::vector<float> marksOf(const TetMesh& mesh, const Attachments& attachments) {
  std::vector<float> marks(mesh.nodes.size(), 0);
  for (const std::int32_t node : attachments.origin) marks[static_cast<std::size_t>(node)] = 1;
  for (const std::int32_t node : attachments.insertion) marks[static_cast<std::size_t>(node)] = 2;
  return marks;
}

/// A tet belongs to the attachment that the most of its nodes belong to.
std::vector<float> marksOfTets(const TetMesh& mesh, const std::vector<float>& nodes) {
  std::vector<float> marks;
  for (const Tet& tet : mesh.tets) {
    std::array<int, 3> counts{};
    for (const std::int32_t node : tet)
      ++counts[static_cast<std::size_t>(nodes[static_cast<std::size_t>(node)])];
    marks.push_back(counts[1] + counts[2] == 0 ? 0.F : counts[1] >= counts[2] ? 1.F : 2.F);
  }
  return marks;
}

/// Puts an array in the place of one of the same name, or behind the others.
void put(std::vector<MeshArray>& arrays, MeshArray array) {
  std::erase_if(arrays, [&](const MeshArray& other) { return other.name == array.name; });
  arrays.push_back(std::move(array));
}

void putArrays(TissueMesh& mesh, const TissueFibres& fibres, const Attachments& attachments) {
  const std::vector<float> marks = marksOf(mesh.mesh, attachments);
  put(mesh.arrays.cells, vectorArray("fibres", fibres.directions));
  put(mesh.arrays.cells, {"attachment", marksOfTets(mesh.mesh, marks)});
  if (!fibres.tendons.empty())
    put(mesh.arrays.cells, {"tendon", {fibres.tendons.begin(), fibres.tendons.end()}});
  put(mesh.arrays.points, {"attachment", marks});
}

int fibres(const CommandLine& line, const FibresCommand& command) {
  checkFibreSettings(command.settings);
  checkMeshFiles(command.files, command.output);
  checkOutput(command, line.common.force);
  TissueMeshInput input = readTissueMesh(command.mesh, command.settings.tissue);
  const Attachments attachments = attachmentsOf(input, command.settings);
  const TissueFibres made = fibresOf(input, attachments, command.settings, OwnFibres::Ignore);
  if (const std::string warning = made.warning(); !warning.empty()) line.warn(command.mesh + ": " + warning);
  putArrays(input.tissue, made, attachments);

  const OutputFolder folder(std::filesystem::absolute(command.output).parent_path());
  OutputFile output(command.output);
  writeMesh(input.tissue, output.temporary(), resolved(command.files));
  output.commit();

  Json json = programFields();
  json["input"] = command.mesh;
  json["output"] = command.output;
  json["tissue"] = input.tissue.regions.front().name;
  json["source"] = made.source;
  json["tets"] = made.directions.size();
  json["tets_without_fibre"] = made.missing;
  json["tets_outside_spline"] = made.outside;
  json["origin_nodes"] = attachments.origin.size();
  json["insertion_nodes"] = attachments.insertion.size();
  line.writeJson(document(json));
  if (std::ostream* stream = line.tables())
    *stream << command.output << ": " << grouped(std::ssize(made.directions)) << " fibres (" << made.source
            << "), origin of " << grouped(std::ssize(attachments.origin)) << " nodes, insertion of "
            << grouped(std::ssize(attachments.insertion)) << '\n';
  return 0;
}

}  // namespace

int runFibres(const std::vector<std::string>& arguments) {
  CommandLine line("fibres",
                   "Gives every tet of a muscle the direction of its fibres, from origin to insertion.");
  FibresCommand command;
  CLI::App& app = line.app;
  app.add_option("MESH", command.mesh, "mesh: " + meshExtensions(&MeshFormat::readable))->required();
  app.add_option(
         "-o,--output", command.output,
         "mesh to write: " + meshExtensions(&MeshFormat::arrays) +
             ", with the cell array fibres (three components), and attachment (1 origin, 2 insertion) of "
             "cells and points")
      ->type_name("FILE")
      ->required();
  addOptions(app, fibreOptions(command.settings));
  for (const Option& option : meshFileOptions(command.files))
    if (option.flags == "--space" || option.flags == "--no-space-tag") addOption(app, option);
  return line.run(arguments, [&] { return fibres(line, command); });
}

}  // namespace sinew
