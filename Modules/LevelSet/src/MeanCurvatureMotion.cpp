#include "sinew/LevelSet/MeanCurvatureMotion.h"

#include "BandRuns.h"
#include "sinew/LevelSet/FastMarching.h"

#include <Eigen/Eigenvalues>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

/// Half width of the band that moves, and of the distance around it, samples.
constexpr float kMoving = 4, kAroundVoxels = 6;
/// phi may start with less.
constexpr float kLeastKnown = 3;
/// b t, samples^2: a ball of 200 samples is gone by then.
constexpr double kLongest = 1e4;
/// Below this |grad phi|^2 the gradient is no normal: beside a skeleton it is a mean over both sides.
constexpr float kFlat = 0.01F;

/// kappa |grad phi| = tr H - n.H n,  n = grad phi / |grad phi|.
float curvatureRate(const Derivatives& d, float squaredSlope) {
  const float along = d.x * d.x * d.xx + d.y * d.y * d.yy + d.z * d.z * d.zz +
                      2 * (d.x * d.y * d.xy + d.x * d.z * d.xz + d.y * d.z * d.yz);
  return d.xx + d.yy + d.zz - along / squaredSlope;
}

float squaredSlope(const Derivatives& d) { return d.x * d.x + d.y * d.y + d.z * d.z; }

/// The same where grad phi = 0: n is the direction in which phi bends most.
float skeletonRate(const Derivatives& d) {
  Eigen::Matrix3f hessian;
  hessian << d.xx, d.xy, d.xz, d.xy, d.yy, d.yz, d.xz, d.yz, d.zz;
  const Eigen::Vector3f bends =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f>(hessian, Eigen::EigenvaluesOnly).eigenvalues();
  const float most = std::abs(bends[0]) > std::abs(bends[2]) ? bends[0] : bends[2];
  return bends.sum() - most;
}

/// Rates and squared slopes at samples first..last-1 of a row, none of them at its ends.
void curvatureRates(const RowStencil& rows, int first, int last, float* rate, float* slope) {
  for (int i = first; i < last; ++i) {
    const Derivatives d = derivatives(rows, i - 1, i, i + 1);
    const float squared = squaredSlope(d);
    slope[i] = squared;
    rate[i] = curvatureRate(d, std::max(squared, kFlat));
  }
}

class Motion {
 public:
  Motion(DenseField& phi, float within) : phi_(phi), slices_(bandRuns(phi, within)) {
    rates_.resize(slices_.size());
    for (std::size_t k = 0; k < slices_.size(); ++k) rates_[k].resize(slices_[k].samples);
  }

  /// phi += b dt / h^2 kappa |grad phi|, phi in samples
  void step(float ratio) {
    tbb::parallel_for(0, phi_.size.z(), [&](int k) { findRates(k); });
    tbb::parallel_for(0, phi_.size.z(), [&](int k) { advance(k, ratio); });
  }

 private:
  void findRates(int k) {
    const BandSlice& slice = slices_[static_cast<std::size_t>(k)];
    float* rates = rates_[static_cast<std::size_t>(k)].data();
    std::vector<float> slopes(static_cast<std::size_t>(phi_.size.x()));
    for (const BandRun& run : slice.runs)
      findRates(RowStencil(phi_, run.j, k), run, rates + run.offset, slopes);
  }

  void findRates(const RowStencil& rows, const BandRun& run, float* rates, std::vector<float>& slopes) const {
    const int last = phi_.size.x() - 1;
    float *rate = rates - run.first, *slope = slopes.data();
    curvatureRates(rows, std::max(run.first, 1), std::min(run.last, last), rate, slope);
    for (int i = run.first; i < run.last; ++i) {
      const bool border = i == 0 || i == last;
      if (!border && slope[i] >= kFlat) continue;
      const Derivatives d = derivatives(rows, std::max(i - 1, 0), i, std::min(i + 1, last));
      const float squared = squaredSlope(d);
      rate[i] = squared < kFlat ? skeletonRate(d) : curvatureRate(d, squared);
    }
  }

  void advance(int k, float ratio) {
    const BandSlice& slice = slices_[static_cast<std::size_t>(k)];
    const float* rates = rates_[static_cast<std::size_t>(k)].data();
    for (const BandRun& run : slice.runs) {
      float* row = phi_.row(run.j, k) + run.first;
      for (int n = 0; n < run.last - run.first; ++n) row[n] += ratio * rates[run.offset + n];
    }
  }

  DenseField& phi_;
  std::vector<BandSlice> slices_;
  std::vector<std::vector<float>> rates_;
};

float largestMagnitude(const DenseField& phi) {
  float largest = 0;
  for (const float v : phi.values) largest = std::max(largest, std::abs(v));
  return largest;
}

void scaleSlices(DenseField& phi, float factor) {
  tbb::parallel_for(0, phi.size.z(), [&](int k) {
    float* slice = phi.row(0, k);
    const std::size_t samples = phi.index(0, 0, 1);
    for (std::size_t n = 0; n < samples; ++n) slice[n] *= factor;
  });
}

void checkArguments(double spacing, double time, double band, const MeanCurvatureMotionOptions& options) {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds)
      throw std::invalid_argument("meanCurvatureMotion: " + std::string(what) + ", got " +
                                  std::to_string(value));
  };
  require(spacing > 0 && std::isfinite(spacing), "spacing must be positive", spacing);
  require(time >= 0 && std::isfinite(time), "time must not be negative", time);
  require(time <= kLongest * spacing * spacing, "time must not exceed 10000 spacing^2", time);
  require(band > 0, "band must be positive", band);
  require(options.cfl > 0 && options.cfl <= 1.0 / 6, "cfl must lie in (0, 1/6]", options.cfl);
  require(options.stepsPerRedistance >= 1, "stepsPerRedistance must be at least 1",
          options.stepsPerRedistance);
}

}  // namespace

MeanCurvatureMotionReport meanCurvatureMotion(DenseField& phi, double spacing, double time, double band,
                                              const MeanCurvatureMotionOptions& options) {
  checkArguments(spacing, time, band, options);
  MeanCurvatureMotionReport report;
  const double samplesSquared = time / (spacing * spacing);  // b t in samples^2
  const int steps = static_cast<int>(std::ceil(samplesSquared / options.cfl));
  if (steps == 0 || phi.values.empty()) return report;
  const auto ratio = static_cast<float>(samplesSquared / steps);
  scaleSlices(phi, static_cast<float>(1 / spacing));
  const auto redistance = [&](const Eigen::Vector3d& h, double width) {
    fastMarching(phi, h, width, {.closestPointLayers = 2});
    ++report.redistances;
  };
  // What lies beyond the band that phi comes with is flat, and is not to be mistaken for skeleton.
  float known = 0.999F * largestMagnitude(phi);
  while (report.steps < steps) {
    if (known < kLeastKnown) {
      redistance(Eigen::Vector3d::Ones(), kAroundVoxels);
      known = kAroundVoxels;
    }
    Motion motion(phi, std::min(kMoving, known));
    const int now = std::min(options.stepsPerRedistance, steps - report.steps);
    for (int step = 0; step < now; ++step) motion.step(ratio);
    report.steps += now;
    known = 0;
  }
  scaleSlices(phi, static_cast<float>(spacing));
  redistance(Eigen::Vector3d::Constant(spacing), band);
  return report;
}

}  // namespace sinew
