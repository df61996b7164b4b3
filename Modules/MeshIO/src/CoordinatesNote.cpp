#include "CoordinatesNote.h"

#include "MeshFormatTable.h"
#include "Words.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace sinew {
namespace {

constexpr std::string_view kBegin = "Sinew mesh, unit ", kMiddle = ", space ", kUnnamed = " to 1 mm";

struct Unit {
  std::string_view name;
  double perMm;
};
constexpr std::array<Unit, 3> kUnits{{{"mm", 1}, {"cm", 0.1}, {"m", 0.001}}};

std::string unitName(double perMm) {
  const auto unit = std::ranges::find(kUnits, perMm, &Unit::perMm);
  if (unit != kUnits.end()) return std::string(unit->name);
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.begin(), digits.end(), perMm).ptr;
  return std::string(digits.data(), end).append(kUnnamed);
}

std::optional<double> unitOf(std::string_view name) {
  const auto unit = std::ranges::find(kUnits, name, &Unit::name);
  if (unit != kUnits.end()) return unit->perMm;
  if (!name.ends_with(kUnnamed)) return std::nullopt;
  const auto perMm = numberOf<double>(name.substr(0, name.size() - kUnnamed.size()));
  return perMm && std::isnormal(*perMm) && *perMm > 0 ? perMm : std::nullopt;
}

}  // namespace

std::string coordinatesNote(const WriteMeshOptions& options) {
  return std::string(kBegin) + unitName(options.perMm) + std::string(kMiddle) + toString(options.space);
}

std::optional<WriteMeshOptions> readCoordinatesNote(std::string_view line) {
  while (line.ends_with('\r') || line.ends_with(' ')) line.remove_suffix(1);
  const std::size_t middle = line.find(kMiddle);
  if (!line.starts_with(kBegin) || middle == line.npos || middle < kBegin.size()) return std::nullopt;
  const auto perMm = unitOf(line.substr(kBegin.size(), middle - kBegin.size()));
  const std::string_view space = line.substr(middle + kMiddle.size());
  if (!perMm || (space != toString(Space::Lps) && space != toString(Space::Ras))) return std::nullopt;
  WriteMeshOptions options;
  options.perMm = *perMm;
  options.space = space == toString(Space::Ras) ? Space::Ras : Space::Lps;
  return options;
}

Eigen::Vector3d fromFile(const Eigen::Vector3d& x, const WriteMeshOptions& options) {
  const double turn = options.space == Space::Ras ? -1 : 1;
  return Eigen::Vector3d(turn * x.x(), turn * x.y(), x.z()) / options.perMm;
}

}  // namespace sinew
