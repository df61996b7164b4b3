#include "TissueMeshInput.h"

#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/RegionMesh.h"
#include "sinew/Simulation/MeshTrial.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <stdexcept>

namespace sinew {
namespace {

bool sameText(const std::string& a, const std::string& b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// The first of the tissues, for messages.
std::string listOf(const std::vector<TissueRegion>& regions) {
  constexpr std::size_t kMost = 8;
  std::string list;
  for (std::size_t r = 0; r < std::min(regions.size(), kMost); ++r)
    list += (r == 0 ? "" : ", ") + regions[r].name + " (" + std::to_string(regions[r].label) + ")";
  return list + (regions.size() > kMost ? ", ..." : "");
}

std::int32_t labelOf(const TissueMesh& mesh, const std::string& file, const std::string& wish) {
  if (wish.empty()) {
    if (mesh.regions.size() == 1) return mesh.regions.front().label;
    throw std::runtime_error(file + ": holds " + std::to_string(mesh.regions.size()) +
                             " tissues; choose one of them with --label: " + listOf(mesh.regions));
  }
  const std::optional<std::int32_t> label = findTissue(mesh, wish);
  if (!label) throw std::runtime_error(file + ": has no tissue " + wish + "; it has " + listOf(mesh.regions));
  return *label;
}

}  // namespace

std::optional<std::int32_t> findTissue(const TissueMesh& mesh, const std::string& wish) {
  std::int32_t number = 0;
  const char* end = wish.data() + wish.size();
  const bool isNumber = std::from_chars(wish.data(), end, number).ptr == end && !wish.empty();
  for (const TissueRegion& region : mesh.regions)
    if (sameText(region.name, wish)) return region.label;
  for (const TissueRegion& region : mesh.regions)
    if (isNumber && region.label == number) return region.label;
  return std::nullopt;
}

TissueMeshInput readTissueMesh(const std::string& file, const std::string& wish) {
  TissueMeshInput input{file, readMesh(file, {.cellArrays = true}), {}};
  input.tissue = regionMesh(input.all, labelOf(input.all, file, wish));
  try {
    checkTetsAtRest(input.tissue.mesh);
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
  TissueRegion& region = input.tissue.regions.front();
  if (!region.named) {
    const std::string name = std::filesystem::path(file).filename().string();
    region.name = name.substr(0, name.size() - findMeshFormat(name)->extension.size());
  }
  return input;
}

}  // namespace sinew
