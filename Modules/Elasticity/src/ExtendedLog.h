#pragma once

#include <cmath>

namespace sinew {

/// ln J and its derivatives; below kFrom the parabola with the value, slope and curvature that ln has there.
struct ExtendedLog {
  static constexpr double kFrom = 0.2;

  double value, slope, curvature;

  explicit ExtendedLog(double J) {
    if (J >= kFrom) {
      value = std::log(J);
      slope = 1 / J;
      curvature = -1 / (J * J);
    } else {
      const double d = (J - kFrom) / kFrom;
      value = std::log(kFrom) + d - d * d / 2;
      slope = (1 - d) / kFrom;
      curvature = -1 / (kFrom * kFrom);
    }
  }
};

}  // namespace sinew
