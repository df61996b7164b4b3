#include "sinew/Pipeline/Smoothing.h"

#include <charconv>
#include <cmath>
#include <stdexcept>

namespace sinew {

double Smoothing::motion(double voxel) const {
  const double scale = length.millimetres(voxel);
  return kind == Kind::Time ? time : kind == Kind::Length ? scale * scale / 2 : 0;
}

Smoothing parseSmoothing(std::string_view text) {
  Smoothing smoothing;
  if (text == "none" || text == "light") {
    smoothing.kind = text == "none" ? Smoothing::Kind::None : Smoothing::Kind::Light;
    return smoothing;
  }
  double value = 0;
  const auto [unit, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const std::string_view suffix = text.substr(static_cast<std::size_t>(unit - text.data()));
  const bool isTime = suffix.empty() || suffix == "mm2" || suffix == "mm^2";
  if (error != std::errc() || !(value >= 0) || !std::isfinite(value) ||
      !(isTime || suffix == "mm" || suffix == "vox"))
    throw std::invalid_argument("'" + std::string(text) +
                                "' is no smoothing: write none, light, a time like 2mm2 or a length like 1mm "
                                "or 2vox");
  smoothing.kind = isTime ? Smoothing::Kind::Time : Smoothing::Kind::Length;
  if (isTime)
    smoothing.time = value;
  else
    smoothing.length = suffix == "vox" ? Length::voxels(value) : Length(value);
  return smoothing;
}

std::string toString(const Smoothing& smoothing) {
  switch (smoothing.kind) {
    case Smoothing::Kind::None:
      return "none";
    case Smoothing::Kind::Light:
      break;
    case Smoothing::Kind::Time:
      return toString(Length(smoothing.time)) + "2";
    case Smoothing::Kind::Length:
      return toString(smoothing.length);
  }
  return "light";
}

}  // namespace sinew
