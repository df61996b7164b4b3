#include "sinew/LevelSet/VolumeKeepingIso.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {

double volumeKeepingIso(const DenseField& field, std::int64_t count) {
  const auto samples = static_cast<std::int64_t>(field.values.size());
  if (count <= 0 || count >= samples)
    throw std::invalid_argument("volumeKeepingIso: count " + std::to_string(count) + " is not inside (0, " +
                                std::to_string(samples) + ")");
  constexpr int kBins = 4096;
  std::array<std::int64_t, kBins> histogram{};
  for (const float value : field.values)
    ++histogram[static_cast<std::size_t>(std::clamp(static_cast<int>(value * kBins), 0, kBins - 1))];

  std::int64_t above = 0;
  int bin = kBins - 1;
  while (above + histogram[static_cast<std::size_t>(bin)] < count)
    above += histogram[static_cast<std::size_t>(bin--)];
  const double inBin =
      static_cast<double>(count - above) / static_cast<double>(histogram[static_cast<std::size_t>(bin)]);
  return std::clamp((bin + 1 - inBin) / kBins, 0.5 / kBins, 1 - 0.5 / kBins);
}

}  // namespace sinew
