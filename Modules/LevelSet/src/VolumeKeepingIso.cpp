#include "sinew/LevelSet/VolumeKeepingIso.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {

double volumeKeepingIso(const DenseField& field, double count) {
  const auto samples = static_cast<double>(field.values.size());
  if (!(count > 0 && count < samples))
    throw std::invalid_argument("volumeKeepingIso: count " + std::to_string(count) + " is not inside (0, " +
                                std::to_string(samples) + ")");
  constexpr int kBins = 4096;
  std::array<std::int64_t, kBins> histogram{};
  for (const float value : field.values)
    ++histogram[static_cast<std::size_t>(std::clamp(static_cast<int>(value * kBins), 0, kBins - 1))];

  const auto samplesIn = [&](int bin) {
    return static_cast<double>(histogram[static_cast<std::size_t>(bin)]);
  };
  double above = 0;
  int bin = kBins - 1;
  while (above + samplesIn(bin) < count) above += samplesIn(bin--);
  const double inBin = (count - above) / samplesIn(bin);
  return std::clamp((bin + 1 - inBin) / kBins, 0.5 / kBins, 1 - 0.5 / kBins);
}

}  // namespace sinew
