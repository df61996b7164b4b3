#include "BccTopology.h"

#include <algorithm>
#include <array>
#include <utility>

namespace sinew {
namespace {

/// Corner c of a cell is at (c & 1, c >> 1 & 1, c >> 2 & 1).
constexpr std::array<std::array<int, 2>, 12> kCellEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
/// The corners of the faces towards +x, +y, +z, in cyclic order.
constexpr std::array<std::array<int, 4>, 3> kUpperFaces{{{1, 3, 7, 5}, {2, 6, 7, 3}, {4, 5, 7, 6}}};

/// Whether a simplex with these vertices is cut by the surface.
template <typename... Vertices>
int isCut(int first, Vertices... others) {
  return ((others != first) || ...) ? 1 : 0;
}

}  // namespace

BccTopology::BccTopology(int nx, int ny) : nx_(nx), ny_(ny) {
  const auto samples = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
  previous_.assign(samples, 1.0F);
  for (Slice* s : {&belowLower_, &below_, &above_, &lower_, &upper_}) {
    s->inside.assign(samples, 0);
    s->piece.assign(samples, 0);
  }
}

std::int32_t BccTopology::find(std::int32_t node) const {
  while (parent_[static_cast<std::size_t>(node)] != node) {
    std::int32_t& up = parent_[static_cast<std::size_t>(node)];
    up = parent_[static_cast<std::size_t>(up)];
    node = up;
  }
  return node;
}

void BccTopology::join(std::int32_t a, std::int32_t b) {
  if (a == b) return;
  a = find(a);
  b = find(b);
  if (a != b) parent_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

void BccTopology::labelSlice(const float* phi) {
  for (int j = 0; j < ny_; ++j)
    for (int i = 0; i < nx_; ++i) {
      const auto p = static_cast<std::size_t>(i + j * nx_);
      above_.inside[p] = phi[p] < 0;
      if (!above_.inside[p]) continue;
      std::int32_t& piece = above_.piece[p];
      if (i > 0 && above_.inside[p - 1]) {
        piece = above_.piece[p - 1];
      } else {
        piece = static_cast<std::int32_t>(parent_.size());
        parent_.push_back(piece);
      }
      const auto row = static_cast<std::size_t>(nx_);
      if (j > 0 && above_.inside[p - row]) join(piece, above_.piece[p - row]);
      if (below_.inside[p]) join(piece, below_.piece[p]);
    }
}

void BccTopology::labelLayer(const float* below, const float* above) {
  const auto row = static_cast<std::size_t>(nx_);
  for (int j = 0; j + 1 < ny_; ++j)
    for (int i = 0; i + 1 < nx_; ++i) {
      const auto p = static_cast<std::size_t>(i + j * nx_);
      const std::array<std::size_t, 4> corner{p, p + 1, p + row, p + row + 1};
      int count = 0;
      for (const std::size_t c : corner) count += below_.inside[c] + above_.inside[c];
      upper_.inside[p] = 0;
      if (count == 0) continue;
      if (count == 8) {
        upper_.inside[p] = 1;
        upper_.piece[p] = below_.piece[p];
        continue;
      }
      float sum = 0;
      for (const std::size_t c : corner) sum += below[c] + above[c];
      if (!(sum < 0)) continue;
      upper_.inside[p] = 1;
      std::int32_t piece = -1;
      for (const std::size_t c : corner)
        for (const Slice* s : {&below_, &above_}) {
          if (!s->inside[c]) continue;
          if (piece >= 0) join(piece, s->piece[c]);
          piece = s->piece[c];
        }
      upper_.piece[p] = piece;
    }
  for (int j = 0; j + 1 < ny_; ++j)
    for (int i = 0; i + 1 < nx_; ++i) {
      const auto p = static_cast<std::size_t>(i + j * nx_);
      if (!upper_.inside[p]) continue;
      if (upper_.inside[p + 1]) join(upper_.piece[p], upper_.piece[p + 1]);
      if (upper_.inside[p + row]) join(upper_.piece[p], upper_.piece[p + row]);
      if (lower_.inside[p]) join(upper_.piece[p], lower_.piece[p]);
    }
}

/// The surface's part that cell `at` of the lower layer owns: V - E + F with V its cut edges, E its cut
/// triangles, F its cut tetrahedra. It owns the edges from its corner 0 and the simplices with its centre,
/// towards +x, +y, +z.
int BccTopology::cellEuler(int at) const {
  const auto p = static_cast<std::size_t>(at), row = static_cast<std::size_t>(nx_);
  std::array<int, 8> corner;
  for (std::size_t c = 0; c < 8; ++c)
    corner[c] = ((c & 4) != 0 ? below_ : belowLower_).inside[p + (c & 1) + ((c >> 1) & 1) * row];
  const int centre = lower_.inside[p];
  const std::array<int, 3> next{lower_.inside[p + 1], lower_.inside[p + row], upper_.inside[p]};
  int sum = centre;
  for (const int c : corner) sum += c;
  for (const int n : next) sum += n;
  if (sum == 0 || sum == 12) return 0;

  int edges = isCut(corner[0], corner[1]) + isCut(corner[0], corner[2]) + isCut(corner[0], corner[4]);
  int triangles = 0, tets = 0;
  for (const int c : corner) edges += isCut(c, centre);
  for (const int n : next) edges += isCut(n, centre);
  for (const auto& [a, b] : kCellEdges)
    triangles += isCut(centre, corner[static_cast<std::size_t>(a)], corner[static_cast<std::size_t>(b)]);
  for (std::size_t f = 0; f < 3; ++f)
    for (std::size_t c = 0; c < 4; ++c) {
      const int first = corner[static_cast<std::size_t>(kUpperFaces[f][c])],
                second = corner[static_cast<std::size_t>(kUpperFaces[f][(c + 1) % 4])];
      triangles += isCut(centre, next[f], first);
      tets += isCut(centre, next[f], first, second);
    }
  return edges - triangles + tets;
}

void BccTopology::countLayer() {
  for (int j = 0; j + 2 < ny_; ++j)
    for (int i = 0; i + 2 < nx_; ++i) euler_ += cellEuler(i + j * nx_);
}

void BccTopology::addSlice(const float* phi) {
  std::swap(belowLower_, below_);
  std::swap(below_, above_);
  std::swap(lower_, upper_);
  labelSlice(phi);
  labelLayer(previous_.data(), phi);
  countLayer();
  previous_.assign(phi, phi + previous_.size());
}

std::int64_t BccTopology::components() const {
  std::int64_t count = 0;
  for (std::size_t n = 0; n < parent_.size(); ++n) count += parent_[n] == static_cast<std::int32_t>(n);
  return count;
}

}  // namespace sinew
