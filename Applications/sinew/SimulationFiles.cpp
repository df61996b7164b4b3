#include "SimulationFiles.h"

#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/Mesher/MeshQuality.h"
#include "sinew/Pipeline/FileNames.h"

#include <CLI/CLI.hpp>

#include <algorithm>

namespace sinew {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kFrameDigits = 3;  // at least

/// The last parts of a path.
std::string lastParts(const fs::path& path, std::size_t count) {
  const std::vector<fs::path> parts(path.begin(), path.end());
  fs::path last;
  for (std::size_t p = parts.size() - std::min(count, parts.size()); p < parts.size(); ++p) last /= parts[p];
  return last.generic_string();
}

}  // namespace

std::vector<std::string> shortNames(const std::vector<std::string>& files) {
  std::vector<fs::path> paths;
  for (const std::string& file : files) paths.push_back(fs::absolute(file).lexically_normal());
  std::vector<std::string> names;
  for (const fs::path& path : paths) {
    if (std::ranges::count(paths, path) > 1)
      throw CLI::ValidationError("MESH", path.string() + " is given twice");
    const auto shared = [&](std::size_t parts) {
      const auto same = [&](const fs::path& other) {
        return lastParts(other, parts) == lastParts(path, parts);
      };
      return std::ranges::count_if(paths, same) > 1;
    };
    std::size_t parts = 1;
    while (shared(parts)) ++parts;
    names.push_back(lastParts(path, parts));
  }
  return names;
}

std::vector<std::string> stemsOf(const std::vector<std::string>& names) {
  std::vector<Tissue> tissues;
  for (const std::string& name : names) {
    Tissue& tissue = tissues.emplace_back();
    tissue.name = fs::path(name).replace_extension().generic_string();
    tissue.label = static_cast<std::int32_t>(tissues.size());
  }
  return tissueFileStems(tissues);
}

std::vector<std::string> TrialOutputs::olderIn(const fs::path& folder) const {
  const auto isOwn = [&](const std::string& name) {
    return name == report || name == table || name == plot ||
           std::ranges::any_of(stems, [&](const std::string& stem) { return TrialSeries::owns(stem, name); });
  };
  std::vector<std::string> names;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (const std::string name = entry.path().filename().string(); isOwn(name)) names.push_back(name);
  std::ranges::sort(names);
  return names;
}

TrialOutputs trialOutputs(const SimulateCommand& command, const std::vector<std::string>& meshNames) {
  const std::string trial(trialName(command.trial.trial));
  TrialOutputs names{"report.json", trial + ".csv", trial + ".svg", {trial}};
  if (meshNames.size() == 1) return names;
  names.stems.clear();
  for (const std::string& stem : stemsOf(meshNames)) names.stems.push_back(stem + "-" + trial);
  return names;
}

std::vector<std::string> missingIn(const fs::path& folder, std::vector<std::string> names) {
  std::erase_if(names, [&](const std::string& name) { return fs::exists(folder / name); });
  return names;
}

TrialSeries::TrialSeries(fs::path folder, std::string stem, TissueMesh rest, NodeVectors fibres)
    : folder_(std::move(folder)),
      stem_(std::move(stem)),
      mesh_(std::move(rest)),
      body_(elasticBody(mesh_.mesh)),
      fibres_(std::move(fibres)) {}

std::string TrialSeries::frameName(const std::string& stem, std::size_t frame) {
  const std::string number = std::to_string(frame);
  return stem + '-' + std::string(kFrameDigits - std::min(kFrameDigits, number.size()), '0') + number +
         ".vtu";
}

bool TrialSeries::owns(const std::string& stem, const std::string& name) {
  if (name == listName(stem)) return true;
  const std::string start = stem + '-', end = ".vtu";
  if (!name.starts_with(start) || !name.ends_with(end)) return false;
  const std::string number = name.substr(start.size(), name.size() - start.size() - end.size());
  return number.size() >= kFrameDigits && number.find_first_not_of("0123456789") == number.npos;
}

void TrialSeries::add(double time, const NodeVectors& places) {
  NodeVectors displacement(places.size()), fibres(fibres_.size());
  for (std::size_t n = 0; n < places.size(); ++n) displacement[n] = places[n] - body_.rest[n];
  std::vector<float> aspectRatio(body_.tets.size()), volumeRatio(body_.tets.size());
  for (std::size_t t = 0; t < body_.tets.size(); ++t) {
    const Eigen::Matrix3d F = deformationGradient(body_, places, t);
    const auto& [a, b, c, d] = body_.tets[t];
    aspectRatio[t] = static_cast<float>(tetQuality(places[a], places[b], places[c], places[d]).aspectRatio);
    volumeRatio[t] = static_cast<float>(F.determinant());
    if (!fibres.empty()) fibres[t] = (F * fibres_[t]).stableNormalized();
  }
  mesh_.mesh.nodes = places;
  mesh_.arrays.cells = {{"aspect_ratio", std::move(aspectRatio)}, {"J", std::move(volumeRatio)}};
  if (!fibres.empty()) mesh_.arrays.cells.push_back(vectorArray("fibres", fibres));
  mesh_.arrays.points = {vectorArray("displacement", displacement)};
  frames_.push_back({time, frameName(stem_, frames_.size())});
  writeMesh(mesh_, folder_ / frames_.back().file);
}

void TrialSeries::finish() const { writeMeshSeries(frames_, folder_ / listName(stem_)); }

}  // namespace sinew
