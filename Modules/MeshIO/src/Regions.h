#pragma once

#include "sinew/MeshIO/TissueMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>

namespace sinew {

/// What a label is of which no file says anything.
inline TissueRegion unnamedRegion(std::int32_t label) {
  return {.label = label, .name = "Segment_" + std::to_string(label), .named = false};
}

using ColorBytes = std::array<std::uint8_t, 3>;

inline ColorBytes toBytes(const std::array<double, 3>& color) {
  ColorBytes bytes{};
  std::ranges::transform(color, bytes.begin(), [](double part) {
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0, 1.0)));
  });
  return bytes;
}

/// The colour of every label.
inline std::map<std::int32_t, ColorBytes> regionColors(const std::vector<TissueRegion>& regions) {
  std::map<std::int32_t, ColorBytes> colors;
  for (const TissueRegion& region : regions) colors.try_emplace(region.label, toBytes(region.color));
  return colors;
}

}  // namespace sinew
