#include "SimplePoint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <vector>

namespace sinew {
namespace {

constexpr int kSamples = 27, kMiddle = 13;

struct Offset {
  int i, j, k;
};
constexpr Offset offsetOf(int bit) { return {bit % 3 - 1, bit / 3 % 3 - 1, bit / 9 - 1}; }
constexpr int magnitude(int a) { return a < 0 ? -a : a; }

/// For every sample of the 27, those that it touches: by a face only, or by an edge or corner too.
constexpr std::array<Neighbourhood, kSamples> touching(bool corners) {
  std::array<Neighbourhood, kSamples> masks{};
  for (int a = 0; a < kSamples; ++a)
    for (int b = 0; b < kSamples; ++b) {
      const Offset p = offsetOf(a), q = offsetOf(b);
      const int di = magnitude(p.i - q.i), dj = magnitude(p.j - q.j), dk = magnitude(p.k - q.k);
      const bool near = corners ? std::max({di, dj, dk}) == 1 : di + dj + dk == 1;
      if (near) masks[static_cast<std::size_t>(a)] |= Neighbourhood{1} << b;
    }
  return masks;
}

constexpr std::array<Neighbourhood, kSamples> kByFaces = touching(false), kByCorners = touching(true);
constexpr Neighbourhood kAll26 = kByCorners[kMiddle], kFaces6 = kByFaces[kMiddle];

/// The 18 samples that share a face or an edge with the middle one.
constexpr Neighbourhood nearest18() {
  Neighbourhood mask = 0;
  for (int bit = 0; bit < kSamples; ++bit) {
    const Offset o = offsetOf(bit);
    const int distance = magnitude(o.i) + magnitude(o.j) + magnitude(o.k);
    if (distance == 1 || distance == 2) mask |= Neighbourhood{1} << bit;
  }
  return mask;
}
constexpr Neighbourhood kNearest18 = nearest18();

/// The piece of `set` that holds its bit `seed`.
Neighbourhood pieceAt(Neighbourhood set, int seed, const std::array<Neighbourhood, kSamples>& neighbours) {
  Neighbourhood piece = Neighbourhood{1} << seed, front = piece;
  while (front != 0) {
    Neighbourhood next = 0;
    for (; front != 0; front &= front - 1)
      next |= neighbours[static_cast<std::size_t>(std::countr_zero(front))];
    front = next & set & ~piece;
    piece |= front;
  }
  return piece;
}

}  // namespace

Neighbourhood neighbourhoodOf(const DenseField& phi, const Eigen::Vector3i& at) {
  Neighbourhood result = 0;
  for (int bit = 0; bit < kSamples; ++bit) {
    const Offset o = offsetOf(bit);
    const Eigen::Vector3i n = at + Eigen::Vector3i(o.i, o.j, o.k);
    if ((n.array() < 0).any() || (n.array() >= phi.size.array()).any()) continue;
    if (phi(n.x(), n.y(), n.z()) < 0) result |= Neighbourhood{1} << bit;
  }
  return result;
}

bool isSimplePoint(Neighbourhood neighbourhood) {
  const Neighbourhood inside = neighbourhood & kAll26;
  if (inside == 0 || pieceAt(inside, std::countr_zero(inside), kByCorners) != inside) return false;
  const Neighbourhood outside = ~neighbourhood & kNearest18;
  const Neighbourhood touchingFaces = outside & kFaces6;
  if (touchingFaces == 0) return false;
  const Neighbourhood piece = pieceAt(outside, std::countr_zero(touchingFaces), kByFaces);
  return (touchingFaces & ~piece) == 0;
}

DenseMask insideOf(const DenseField& phi) {
  DenseMask inside(phi.size);
  std::ranges::transform(phi.values, inside.values.begin(), [](float value) { return value < 0 ? 1 : 0; });
  return inside;
}

std::int64_t holdTopology(const DenseMask& inside, DenseField& wanted, float hold) {
  struct Change {
    float goal;
    Eigen::Vector3i at;
  };
  std::vector<Change> changes;
  for (int k = 0; k < wanted.size.z(); ++k)
    for (int j = 0; j < wanted.size.y(); ++j) {
      const std::uint8_t* side = inside.row(j, k);
      float* phi = wanted.row(j, k);
      for (int i = 0; i < wanted.size.x(); ++i)
        if ((side[i] != 0) != (phi[i] < 0)) {
          changes.push_back({phi[i], {i, j, k}});
          phi[i] = side[i] != 0 ? -hold : hold;  // the old side, until it may change
        }
    }
  std::ranges::stable_sort(changes, std::greater(), [](const Change& c) { return std::abs(c.goal); });
  for (std::size_t before = changes.size() + 1; changes.size() < before;) {
    before = changes.size();
    std::erase_if(changes, [&](const Change& change) {
      const bool simple = isSimplePoint(neighbourhoodOf(wanted, change.at));
      if (simple) wanted(change.at.x(), change.at.y(), change.at.z()) = change.goal;
      return simple;
    });
  }
  return static_cast<std::int64_t>(changes.size());
}

}  // namespace sinew
