#include "sinew/LevelSet/Reinitialize.h"

#include "BandRuns.h"
#include "StepsFromSurface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

float minmod(float a, float b) {
  if (a * b <= 0) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

bool inside(float phi) { return phi < 0; }

/// Five samples along an axis around `here`; beyond the raster lies the outermost one.
struct Line {
  float before2, before, here, after, after2;

  Line(const float* phi, std::ptrdiff_t stride, int i, int size) {
    const int low = std::min(i, 2), high = std::min(size - 1 - i, 2);
    here = *phi;
    before = low > 0 ? phi[-stride] : here;
    before2 = low > 1 ? phi[-2 * stride] : before;
    after = high > 0 ? phi[stride] : here;
    after2 = high > 1 ? phi[2 * stride] : after;
  }
};

/// The smaller second difference of the two samples at the ends of an edge.
float bendAfter(const Line& f) {
  return minmod(f.after - 2 * f.here + f.before, f.after2 - 2 * f.after + f.here);
}
float bendBefore(const Line& f) {
  return minmod(f.after - 2 * f.here + f.before, f.here - 2 * f.before + f.before2);
}

/// Where on an edge of length 1 the parabola through both ends with this second derivative is zero.
float crossing(float here, float there, float bend) {
  const float linear = here / (here - there);
  if (std::abs(bend) < 1e-4F * std::abs(here - there)) return linear;
  const float middle = 0.5F * bend - here - there, root = middle * middle - 4 * here * there;
  const float at =
      0.5F + (here - there - std::copysign(std::sqrt(std::max(root, 0.0F)), here - there)) / bend;
  return std::clamp(at, 0.0F, 1.0F);
}

/// d phi / dx towards the neighbour, as seen from here; `reach` is where the difference ends.
struct Difference {
  float slope, reach;
};

/// Second-order difference towards the neighbour: to its value, or to the surface when that lies between.
///     (phi_1 - phi)/1 - bend/2          or          (0 - phi)/s - s bend/2
Difference towards(float here, float there, float bend, float start, float startThere, float startBend) {
  if (inside(start) == inside(startThere)) return {there - here - 0.5F * bend, 1};
  constexpr float kLeast = 1e-3F;  // samples; nearer than this the sample is as good as on the surface
  const float s = std::max(crossing(start, startThere, startBend), kLeast);
  return {-here / s - 0.5F * s * bend, s};
}

/// What upwind differences of a sample say.
struct Slope {
  float magnitude;  ///< |grad phi|
  float reach;      ///< the shortest difference, samples
};

/// Godunov's choice: of the slopes that run away from the surface the steepest.
class Godunov {
 public:
  Godunov(const DenseField& start, const Eigen::Vector3i& size)
      : start_(start.values.data()),
        size_{size.x(), size.y(), size.z()},
        stride_{1, size.x(), std::ptrdiff_t{size.x()} * size.y()} {}

  Slope operator()(const float* phi, std::size_t n, const std::array<int, 3>& at) const {
    const float sign = inside(start_[n]) ? -1.0F : 1.0F;
    float squared = 0, reach = 1;
    for (std::size_t a = 0; a < 3; ++a) {
      const Line f(phi + n, stride_[a], at[a], size_[a]), f0(start_ + n, stride_[a], at[a], size_[a]);
      const Difference after = towards(f.here, f.after, bendAfter(f), f0.here, f0.after, bendAfter(f0));
      const Difference before = towards(f.here, f.before, bendBefore(f), f0.here, f0.before, bendBefore(f0));
      const float steepest = std::max({-sign * after.slope, -sign * before.slope, 0.0F});
      squared += steepest * steepest;
      reach = std::min({reach, after.reach, before.reach});
    }
    return {std::sqrt(squared), reach};
  }

 private:
  const float* start_;
  std::array<int, 3> size_;
  std::array<std::ptrdiff_t, 3> stride_;
};

/// Sums and maxima over the samples of the band.
struct Misfit {
  double sum = 0, largest = 0;
  std::int64_t samples = 0;

  void add(double error) {
    sum += error;
    largest = std::max(largest, error);
    ++samples;
  }
  void add(const Misfit& other) {
    sum += other.sum;
    largest = std::max(largest, other.largest);
    samples += other.samples;
  }
};

class Evolution {
  /// phi stays within the band and this much, samples: steep flanks must not bend what lies beside them.
  static constexpr float kBeyond = 2;
  static constexpr float kMostSteps = 250;

 public:
  /// @param phi,band  in samples
  Evolution(DenseField& phi, float band)
      : phi_(phi),
        start_(phi),
        band_(band),
        godunov_(start_, phi.size),
        misfits_(static_cast<std::size_t>(phi.size.z())) {
    // The city-block distance is at most sqrt 3 times the distance.
    const int steps =
        static_cast<int>(std::min(std::ceil((band + kBeyond) * std::numbers::sqrt3_v<float>), kMostSteps));
    slices_ = bandRuns(stepsFromSurface(phi, steps), steps);
    for (const BandSlice& slice : slices_) changes_.emplace_back(slice.samples);
    before_ = changes_;
    clampTo(band + kBeyond);
  }

  /// phi' = phi - dtau S (|grad phi| - 1) at every sample of the band, twice, and the mean with phi: Heun's
  /// rule,
  /// without which second-order differences never quite settle. Returns what phi still had to change.
  Misfit step(float cfl) {
    forEachSlice([&](int k) { keep(k); });
    const Misfit misfit = measure(cfl);
    forEachSlice([&](int k) { advance(k); });
    measure(cfl);
    forEachSlice([&](int k) { advanceHalfway(k); });
    return misfit;
  }

  /// ||grad phi| - 1| as it is now.
  Misfit measure(float cfl) {
    forEachSlice([&](int k) { misfits_[static_cast<std::size_t>(k)] = findChanges(k, cfl); });
    Misfit all;
    for (const Misfit& slice : misfits_) all.add(slice);
    return all;
  }

  void clampTo(float limit) {
    forEachSlice([&](int k) {
      const std::size_t first = phi_.index(0, 0, k), last = phi_.index(0, 0, k + 1);
      for (std::size_t n = first; n < last; ++n) phi_.values[n] = std::clamp(phi_.values[n], -limit, limit);
    });
  }

  /// Of the crossings on the raster's edges, samples.
  double largestMovement() const {
    std::vector<double> largest(slices_.size(), 0);
    forEachSlice([&](int k) { largest[static_cast<std::size_t>(k)] = largestMovement(k); });
    return largest.empty() ? 0 : *std::max_element(largest.begin(), largest.end());
  }

 private:
  template <typename Visit>
  void forEachSlice(const Visit& visit) const {
    tbb::parallel_for(0, phi_.size.z(), visit);
  }

  template <typename Visit>
  void forEachSample(int k, const Visit& visit) const {
    for (const BandRun& run : slices_[static_cast<std::size_t>(k)].runs)
      for (int i = run.first; i < run.last; ++i)
        visit(std::array<int, 3>{i, run.j, k}, run.offset + static_cast<std::size_t>(i - run.first));
  }

  std::size_t index(const std::array<int, 3>& at) const { return phi_.index(at[0], at[1], at[2]); }

  Misfit findChanges(int k, float cfl) {
    Misfit misfit;
    std::vector<float>& changes = changes_[static_cast<std::size_t>(k)];
    forEachSample(k, [&](const std::array<int, 3>& at, std::size_t m) {
      const std::size_t n = index(at);
      const Slope slope = godunov_(phi_.values.data(), n, at);
      const float error = slope.magnitude - 1;
      changes[m] = (inside(start_.values[n]) ? cfl : -cfl) * slope.reach * error;
      if (std::abs(phi_.values[n]) < band_) misfit.add(std::abs(error));
    });
    return misfit;
  }

  void keep(int k) {
    std::vector<float>& before = before_[static_cast<std::size_t>(k)];
    forEachSample(k,
                  [&](const std::array<int, 3>& at, std::size_t m) { before[m] = phi_.values[index(at)]; });
  }

  /// Within the sample's side and the limits.
  float admissible(float moved, bool isInside) const {
    constexpr float kLeast = 1e-6F;  // samples; zero would be outside
    const float most = band_ + kBeyond;
    return isInside ? std::clamp(moved, -most, -kLeast) : std::clamp(moved, 0.0F, most);
  }

  void advance(int k) {
    const std::vector<float>& changes = changes_[static_cast<std::size_t>(k)];
    forEachSample(k, [&](const std::array<int, 3>& at, std::size_t m) {
      float& phi = phi_.values[index(at)];
      phi = admissible(phi + changes[m], inside(phi));
    });
  }

  void advanceHalfway(int k) {
    const std::vector<float>&changes = changes_[static_cast<std::size_t>(k)],
          &before = before_[static_cast<std::size_t>(k)];
    forEachSample(k, [&](const std::array<int, 3>& at, std::size_t m) {
      float& phi = phi_.values[index(at)];
      phi = admissible(0.5F * (before[m] + phi + changes[m]), inside(phi));
    });
  }

  double largestMovement(int k) const {
    double largest = 0;
    forEachSample(k, [&](const std::array<int, 3>& at, std::size_t) {
      std::array<int, 3> next = at;
      for (std::size_t a = 0; a < 3; ++a, next = at) {
        if (++next[a] >= phi_.size[static_cast<Eigen::Index>(a)]) continue;
        const std::size_t n = index(at), m = index(next);
        if (inside(start_.values[n]) == inside(start_.values[m])) continue;
        const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(m - n);
        const int size = phi_.size[static_cast<Eigen::Index>(a)];
        const auto crossingOf = [&](const DenseField& field) {
          const Line f(field.values.data() + n, stride, at[a], size);
          return crossing(f.here, f.after, bendAfter(f));
        };
        largest = std::max(largest, double{std::abs(crossingOf(phi_) - crossingOf(start_))});
      }
    });
    return largest;
  }

  DenseField& phi_;
  const DenseField start_;
  float band_;
  Godunov godunov_;
  std::vector<BandSlice> slices_;
  std::vector<std::vector<float>> changes_, before_;  ///< run by run
  std::vector<Misfit> misfits_;
};

void scale(DenseField& phi, float factor) {
  for (float& v : phi.values) v *= factor;
}

void checkArguments(double spacing, double band, const ReinitializeOptions& options) {
  const auto require = [](bool holds, const char* what, double value) {
    if (!holds)
      throw std::invalid_argument("reinitialize: " + std::string(what) + ", got " + std::to_string(value));
  };
  require(spacing > 0 && std::isfinite(spacing), "spacing must be positive", spacing);
  require(band > 0 && std::isfinite(band), "band must be positive", band);
  require(options.maxIterations >= 1, "maxIterations must be at least 1", options.maxIterations);
  require(options.cfl > 0 && options.cfl <= 0.5, "cfl must lie in (0, 0.5]", options.cfl);
  require(options.tolerance > 0, "tolerance must be positive", options.tolerance);
}

}  // namespace

ReinitializeReport reinitialize(DenseField& phi, double spacing, double band,
                                const ReinitializeOptions& options) {
  checkArguments(spacing, band, options);
  if (phi.values.empty()) return {.converged = true};
  scale(phi, static_cast<float>(1 / spacing));
  Evolution evolution(phi, static_cast<float>(band / spacing));
  const auto cfl = static_cast<float>(options.cfl);
  ReinitializeReport report;
  for (; !report.converged && report.iterations < options.maxIterations; ++report.iterations)
    report.converged = evolution.step(cfl).largest <= options.tolerance;
  const Misfit misfit = evolution.measure(cfl);
  report.meanGradientError = misfit.samples > 0 ? misfit.sum / static_cast<double>(misfit.samples) : 0;
  report.maxGradientError = misfit.largest;
  report.largestMovement = evolution.largestMovement() * spacing;
  evolution.clampTo(static_cast<float>(band / spacing));
  scale(phi, static_cast<float>(spacing));
  return report;
}

}  // namespace sinew
