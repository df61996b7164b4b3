#include "ConvertCommand.h"
#include "JsonReport.h"
#include "TextTable.h"
#include "sinew/MeshIO/CombineMeshes.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/Pipeline/OutputFile.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <optional>

namespace sinew {
namespace {

namespace fs = std::filesystem;

/// OUT, with the extension of the preset where it has none of a mesh.
std::string outputOf(const ConvertCommand& command) {
  if (findMeshFormat(fs::path(command.output).filename().string()) != nullptr) return command.output;
  if (!command.files.preset.empty()) return command.output + std::string(standardExtension(command.files));
  throw CLI::ValidationError("OUT",
                             command.output + ": unknown kind of mesh file; known are " + meshExtensions());
}

std::string stemOf(const std::string& file) {
  const std::string name = fs::path(file).filename().string();
  const MeshFormat* format = findMeshFormat(name);
  return name.substr(0, name.size() - format->extension.size());
}

std::map<std::int32_t, std::int64_t> tetsByLabel(const TetMesh& mesh) {
  std::map<std::int32_t, std::int64_t> tets;
  for (const std::int32_t label : mesh.labels) ++tets[label];
  return tets;
}

/// A mesh in which every label has a region with a name: that of its file where it had none.
TissueMesh readNamed(const std::string& file, const ReadMeshOptions& reading) {
  TissueMesh mesh = readMesh(file, reading);
  for (const auto& [label, count] : tetsByLabel(mesh.mesh))
    if (std::ranges::count(mesh.regions, label, &TissueRegion::label) == 0)
      mesh.regions.push_back({label, {}});
  for (TissueRegion& region : mesh.regions)
    if (!region.named || region.name.empty())
      region.name =
          mesh.regions.size() == 1 ? stemOf(file) : stemOf(file) + "_" + std::to_string(region.label);
  return mesh;
}

/// Tissues that a file brings once more.
class Repetitions {
 public:
  void add(const std::string& file, const TissueMesh& mesh) {
    std::map<std::pair<std::string, std::int64_t>, std::string> here;
    const std::map<std::int32_t, std::int64_t> tets = tetsByLabel(mesh.mesh);
    for (const TissueRegion& region : mesh.regions)
      here.emplace(std::pair(region.name, tets.at(region.label)), file);
    for (const auto& [tissue, ignored] : here)
      if (const auto found = firstFiles_.find(tissue); found != firstFiles_.end() && count_++ == 0)
        first_ = found->second + " and " + file + " both hold '" + tissue.first + "' with " +
                 grouped(tissue.second) + " tets";
    firstFiles_.merge(here);
  }

  /// One line; empty when there is none.
  std::string warning() const {
    if (count_ == 0) return {};
    const std::string others = count_ == 1 ? ""
                                           : ", and so it is with " + std::to_string(count_ - 1) +
                                                 (count_ == 2 ? " other tissue" : " other tissues");
    return first_ + others + "; each is written twice";
  }

 private:
  std::map<std::pair<std::string, std::int64_t>, std::string> firstFiles_;  ///< by name and number of tets
  std::string first_;
  int count_ = 0;
};

TissueMesh readAll(const CommandLine& line, const std::vector<std::string>& files,
                   const ReadMeshOptions& reading) {
  std::vector<TissueMesh> meshes;
  Repetitions repetitions;
  for (const std::string& file : files) {
    meshes.push_back(readNamed(file, reading));
    repetitions.add(file, meshes.back());
  }
  line.warn(repetitions.warning());
  return combineMeshes(std::move(meshes));
}

void print(std::ostream& stream, const std::string& output, const TissueMesh& mesh,
           const std::optional<CurvedBoundary>& curved) {
  TextTable table({{"label"}, {"tissue", Align::Left}, {"tets"}});
  const std::map<std::int32_t, std::int64_t> tets = tetsByLabel(mesh.mesh);
  for (const TissueRegion& region : mesh.regions)
    table.add({std::to_string(region.label), printable(region.name), grouped(tets.at(region.label))});
  table.print(stream);
  stream << '\n' << output << ": " << grouped(std::ssize(mesh.mesh.tets)) << " tets\n";
  if (curved)
    stream << grouped(std::ssize(curved->edges)) << " of " << grouped(curved->boundaryEdges)
           << " edges of the boundary bend; so that tets stay valid, " << grouped(curved->pulledBackEdges)
           << " of them less than the surface, and " << grouped(curved->straightenedEdges)
           << " more not at all\n";
}

Json toJson(const ConvertCommand& command, const std::string& output, const TissueMesh& mesh,
            const WriteMeshOptions& options, const std::optional<CurvedBoundary>& curved) {
  Json json = programFields();
  json["kind"] = "mesh";
  json["inputs"] = command.inputs;
  json["output"] = output;
  json["unit"] = unitOf(options);
  json["space"] = options.space == Space::Ras ? "RAS" : "LPS";
  json["nodes"] = mesh.mesh.nodes.size();
  json["tets"] = mesh.mesh.tets.size();
  json["regions"] = Json::array();
  const std::map<std::int32_t, std::int64_t> tets = tetsByLabel(mesh.mesh);
  for (const TissueRegion& region : mesh.regions)
    json["regions"].push_back({{"name", region.name},
                               {"label", region.label},
                               {"color", region.color},
                               {"tets", tets.at(region.label)}});
  if (curved)
    json["curved_edges"] = {{"boundary_edges", curved->boundaryEdges},
                            {"bent", curved->edges.size()},
                            {"pulled_back", curved->pulledBackEdges},
                            {"straightened", curved->straightenedEdges},
                            {"at_creases", curved->awayEdges}};
  return json;
}

}  // namespace

std::string convertMeshes(const CommandLine& line, const ConvertCommand& command) {
  const WriteMeshOptions options = resolved(command.files);
  const std::string target = outputOf(command);
  checkMeshFiles(command.files, fs::path(target).filename().string());
  checkOutputFile(target, line.common.force);
  const MeshFormat* format = findMeshFormat(fs::path(target).filename().string());
  TissueMesh mesh = readAll(line, command.inputs, {.cellArrays = format->arrays});
  std::optional<CurvedBoundary> curved;
  if (options.quadratic) {
    curved = curveBoundary(mesh.mesh);
    mesh.curvedEdges = curved->edges;
  }
  const OutputFolder folder(fs::absolute(target).parent_path());
  OutputFile output(target);
  writeMesh(mesh, output.temporary(), options);
  output.commit();
  if (std::ostream* stream = line.tables()) print(*stream, target, mesh, curved);
  return document(toJson(command, target, mesh, options, curved));
}

}  // namespace sinew
