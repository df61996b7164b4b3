#include "sinew/LevelSet/Csg.h"

#include "sinew/LevelSet/SampleLattice.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

/// Samples along the axes, from the first to the last one, inclusive.
struct SampleBox {
  Vector3i lower, upper;
  bool empty() const { return (upper.array() < lower.array()).any(); }
};

/// One of two level sets, or its complement, addressed by the indices of a third raster.
struct Operand {
  const DenseField& phi;
  Vector3i first;  ///< index of the first sample
  float sign = 1;  ///< -1: the complement

  SampleBox box() const { return {first, first + phi.size - Vector3i::Ones()}; }
  /// The row (j, k), addressed from index 0.
  const float* row(int j, int k) const { return phi.row(j - first.y(), k - first.z()) - first.x(); }
  /// Unit normal by central differences, one-sided at the border; zero where phi does not change.
  Vector3d normal(const Vector3i& index) const {
    const Vector3i at = index - first;
    Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      Vector3i before = at, after = at;
      before[axis] = std::max(at[axis] - 1, 0);
      after[axis] = std::min(at[axis] + 1, phi.size[axis] - 1);
      gradient[axis] = phi(after.x(), after.y(), after.z()) - phi(before.x(), before.y(), before.z());
    }
    return sign * gradient.stableNormalized();
  }
};

SampleBox common(const SampleBox& a, const SampleBox& b) {
  return {a.lower.cwiseMax(b.lower), a.upper.cwiseMin(b.upper)};
}

SampleBox around(const SampleBox& a, const SampleBox& b) {
  return {a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)};
}

/// Calls perRow(j, k) for the rows of a box, in parallel.
template <class PerRow>
void forEachRow(const SampleBox& box, const PerRow& perRow) {
  tbb::parallel_for(box.lower.z(), box.upper.z() + 1, [&](int k) {
    for (int j = box.lower.y(); j <= box.upper.y(); ++j) perRow(j, k);
  });
}

/// The result in the making: its samples, addressed by a's indices.
struct Result {
  DenseLevelSet levelSet;
  Vector3i first;

  SampleBox box() const { return {first, first + levelSet.phi.size - Vector3i::Ones()}; }
  float* row(int j, int k) { return levelSet.phi.row(j - first.y(), k - first.z()) - first.x(); }
};

Result copyOf(const DenseLevelSet& a, const SampleBox& box, double band) {
  Result copy{onBox(a, box.lower, box.upper), box.lower};
  copy.levelSet.band = band;
  if (band < a.band)
    for (float& phi : copy.levelSet.phi.values)
      phi = std::clamp(phi, static_cast<float>(-band), static_cast<float>(band));
  return copy;
}

/// result = choose(result, b) where b has samples.
template <class Choose>
void combine(Result& result, const Operand& b, const Choose& choose) {
  const SampleBox box = common(result.box(), b.box());
  const auto band = static_cast<float>(result.levelSet.band);
  forEachRow(box, [&](int j, int k) {
    float* out = result.row(j, k);
    const float* in = b.row(j, k);
    for (int i = box.lower.x(); i <= box.upper.x(); ++i)
      out[i] = choose(out[i], std::clamp(b.sign * in[i], -band, band));
  });
}

/// The union of a and b with a fillet of radius r, both below r; `cosine` between the normals. See Csg.h.
double fillet(double a, double b, double r, double cosine) {
  const double u = r - a, v = r - b, c = std::max(cosine, 0.0), sharp = std::min(a, b);
  if (u <= c * v || v <= c * u) return sharp;  // beyond a line of contact
  return std::min(r - std::sqrt((2 * u * v + (u - v) * (u - v) / (1 - c)) / (1 + c)), sharp);
}

/// Rounds the crease of the union of a and b, or with `sign` -1 that of its complement.
void blendCrease(Result& result, const Operand& a, const Operand& b, double r, float sign) {
  const SampleBox box = common(result.box(), common(a.box(), b.box()));
  const double band = result.levelSet.band;
  forEachRow(box, [&](int j, int k) {
    float* out = result.row(j, k);
    const float *rowA = a.row(j, k), *rowB = b.row(j, k);
    for (int i = box.lower.x(); i <= box.upper.x(); ++i) {
      const double phiA = a.sign * rowA[i], phiB = b.sign * rowB[i];
      if (std::max(phiA, phiB) >= r || std::min(phiA, phiB) <= -band) continue;
      const double c = a.normal({i, j, k}).dot(b.normal({i, j, k}));
      out[i] = sign * static_cast<float>(std::max(fillet(phiA, phiB, r, c), -band));
    }
  });
}

/// Two level sets of one lattice. @throws when they are not, or the blend radius is out of range
struct Pair {
  Pair(const DenseLevelSet& a, const DenseLevelSet& b, double blend, const std::string& operation)
      : band(std::min(a.band, b.band)) {
    const auto shift = firstSampleOn({a.frame, a.voxelSize}, b);
    if (!shift) throw std::invalid_argument(operation + ": the two level sets have not the same lattice");
    if (!(blend >= 0 && blend <= band))
      throw std::invalid_argument(operation + ": blend must lie in [0, " + std::to_string(band) +
                                  "], the band in mm, got " + std::to_string(blend));
    shiftOfB = *shift;
  }

  Vector3i shiftOfB;  ///< of b's first sample, from a's
  double band;        ///< of the result
};

float smaller(float a, float b) { return std::min(a, b); }
float larger(float a, float b) { return std::max(a, b); }

}  // namespace

DenseLevelSet unite(const DenseLevelSet& a, const DenseLevelSet& b, double blend) {
  const Pair pair(a, b, blend, "unite");
  const Operand inA{a.phi, Vector3i::Zero()}, inB{b.phi, pair.shiftOfB};
  Result result = copyOf(a, around(inA.box(), inB.box()), pair.band);
  combine(result, inB, smaller);
  if (blend > 0) blendCrease(result, inA, inB, blend, 1);
  return std::move(result.levelSet);
}

DenseLevelSet intersect(const DenseLevelSet& a, const DenseLevelSet& b, double blend) {
  const Pair pair(a, b, blend, "intersect");
  const Operand outA{a.phi, Vector3i::Zero(), -1}, outB{b.phi, pair.shiftOfB, -1};
  const SampleBox box = common(outA.box(), outB.box());
  if (box.empty())
    return emptyLevelSet({a.frame, a.voxelSize}, Vector3i::Zero(), Vector3i::Zero(), pair.band);
  Result result = copyOf(a, box, pair.band);
  combine(result, {b.phi, pair.shiftOfB}, larger);
  if (blend > 0) blendCrease(result, outA, outB, blend, -1);
  return trimmed(result.levelSet);
}

DenseLevelSet subtract(const DenseLevelSet& a, const DenseLevelSet& b, double blend) {
  const Pair pair(a, b, blend, "subtract");
  const Operand outA{a.phi, Vector3i::Zero(), -1}, inB{b.phi, pair.shiftOfB};
  Result result = copyOf(a, outA.box(), pair.band);
  combine(result, {b.phi, pair.shiftOfB, -1}, larger);
  if (blend > 0) blendCrease(result, outA, inB, blend, -1);
  return trimmed(result.levelSet);
}

}  // namespace sinew
