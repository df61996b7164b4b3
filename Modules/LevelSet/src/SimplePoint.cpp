#include "SimplePoint.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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

std::int64_t holdTopology(const DenseField& kept, DenseField& wanted, float hold) {
  struct Change {
    float depth;  ///< |kept|: how far from its surface
    Eigen::Vector3i at;
  };
  std::vector<Change> changes;
  for (int k = 0; k < kept.size.z(); ++k)
    for (int j = 0; j < kept.size.y(); ++j) {
      const float *a = kept.row(j, k), *b = wanted.row(j, k);
      for (int i = 0; i < kept.size.x(); ++i)
        if ((a[i] < 0) != (b[i] < 0)) changes.push_back({std::abs(a[i]), {i, j, k}});
    }
  if (changes.empty()) return 0;
  std::ranges::stable_sort(changes, {}, &Change::depth);

  // `wanted` first takes the old side at every change, and then the new one as far as it may.
  const auto value = [&](const Eigen::Vector3i& at) -> float& { return wanted(at.x(), at.y(), at.z()); };
  std::vector<float> goals;
  for (const Change& change : changes) {
    goals.push_back(value(change.at));
    value(change.at) = std::copysign(hold, kept(change.at.x(), change.at.y(), change.at.z()));
  }
  std::vector<std::size_t> waiting(changes.size());
  for (std::size_t n = 0; n < waiting.size(); ++n) waiting[n] = n;
  for (std::size_t before = waiting.size() + 1; waiting.size() < before;) {
    before = waiting.size();
    std::erase_if(waiting, [&](std::size_t n) {
      const Eigen::Vector3i& at = changes[n].at;
      if (!isSimplePoint(neighbourhoodOf(wanted, at))) return false;
      value(at) = goals[n];
      return true;
    });
  }
  return static_cast<std::int64_t>(waiting.size());
}

}  // namespace sinew
