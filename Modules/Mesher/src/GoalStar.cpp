#include "GoalStar.h"

#include "GoalMeasure.h"
#include "sinew/Mesher/VectorClones.h"

#include <algorithm>
#include <bit>

namespace sinew {
namespace {

using Eigen::Vector3d;

struct Row3 {
  double x, y, z;
};
inline Row3 operator-(Row3 a, Row3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline double dot(Row3 a, Row3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Row3 cross(Row3 a, Row3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double larger(double a, double b) { return a > b ? a : b; }

/// goalMeasure() of tets (x; a, b, c) with their corners in nine rows.
SINEW_VECTOR_CLONES void measureRows(const double* __restrict corners, std::size_t stride, std::size_t tets,
                                     double px, double py, double pz, double* __restrict out) {
  for (std::size_t t = 0; t < tets; ++t) {
    const double* in = corners + t;
    const Row3 x{px, py, pz}, a{in[0], in[stride], in[2 * stride]},
        b{in[3 * stride], in[4 * stride], in[5 * stride]}, c{in[6 * stride], in[7 * stride], in[8 * stride]};
    const Row3 ab = b - a, ac = c - a, bc = c - b, ax = x - a, bx = x - b, cx = x - c;
    const Row3 n0 = cross(ab, ac), n1 = cross(cx, bx), n2 = cross(ax, cx), n3 = cross(bx, ax);
    const double volume6 = dot(ax, n0);
    const double s0 = std::sqrt(dot(n0, n0)), s1 = std::sqrt(dot(n1, n1)), s2 = std::sqrt(dot(n2, n2)),
                 s3 = std::sqrt(dot(n3, n3));
    const double longest2 = larger(larger(larger(dot(ab, ab), dot(ac, ac)), larger(dot(bc, bc), dot(ax, ax))),
                                   larger(dot(bx, bx), dot(cx, cx)));
    const double aspect = std::sqrt(longest2) * larger(larger(s0, s1), larger(s2, s3)) / volume6;
    const auto miss = [](Row3 n, Row3 m, double areas) {
      return std::abs(-dot(n, m) / areas - kGoalCosineCentre);
    };
    const double cosine = larger(larger(larger(miss(n0, n1, s0 * s1), miss(n0, n2, s0 * s2)),
                                        larger(miss(n0, n3, s0 * s3), miss(n1, n2, s1 * s2))),
                                 larger(miss(n1, n3, s1 * s3), miss(n2, n3, s2 * s3)));
    const double measure = larger(aspect / kGoalAspectRatio, cosine / kGoalCosineRadius);
    out[t] = volume6 > 0 ? measure : kInfinity;
  }
}

SINEW_VECTOR_CLONES void raiseRow(double* row, std::size_t tets, int squarings) {
  for (int s = 0; s < squarings; ++s) {
#pragma omp simd
    for (std::size_t t = 0; t < tets; ++t) row[t] *= row[t];
  }
}

}  // namespace

void GoalStar::gather(std::span<const StarFaceNodes> faces, const std::vector<Vector3d>& nodes) {
  tets_ = faces.size();
  if (capacity_ < tets_) {
    capacity_ = tets_;
    rows_.resize(capacity_ * (kCorners + 1));
  }
  gatherCorners(faces, nodes, capacity_, rows_.data());
}

std::span<const double> GoalStar::measures(const Vector3d& x, std::size_t count) {
  double* out = rows_.data() + kCorners * capacity_;
  measureRows(rows_.data(), capacity_, count, x.x(), x.y(), x.z(), out);
  return {out, count};
}

double GoalStar::energy(const Vector3d& x, int power, std::size_t count) {
  measures(x, count);
  double* row = rows_.data() + kCorners * capacity_;
  raiseRow(row, count, std::countr_zero(static_cast<unsigned>(power)));
  double sum = 0;
  for (std::size_t t = 0; t < count; ++t) sum += row[t];
  return sum;
}

double GoalStar::shortestEdge(const Vector3d& x) const {
  double shortest2 = kInfinity;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const double* in = rows_.data() + 3 * corner * capacity_;
    for (std::size_t t = 0; t < tets_; ++t) {
      const Row3 edge = Row3{in[t], in[capacity_ + t], in[2 * capacity_ + t]} - Row3{x.x(), x.y(), x.z()};
      shortest2 = std::min(shortest2, dot(edge, edge));
    }
  }
  return std::sqrt(shortest2);
}

void GoalStar::swap(std::size_t s, std::size_t t) {
  for (std::size_t row = 0; row < kCorners; ++row)
    std::swap(rows_[row * capacity_ + s], rows_[row * capacity_ + t]);
}

}  // namespace sinew
