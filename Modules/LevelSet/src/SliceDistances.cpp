#include "sinew/LevelSet/SliceDistances.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sinew {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

/// One slice, seen along its rows or, with the axes exchanged, along its columns.
struct SliceView {
  const float* values;
  int n, lines;               ///< samples along a line, number of lines
  std::ptrdiff_t step, next;  ///< from sample to sample, from line to line
  float along, across;        ///< spacing, mm

  bool inside(int s, int line) const { return values[s * step + line * next] < 0; }
  float value(int s, int line) const { return values[s * step + line * next]; }
};

/// Squared distance from every sample of a line to the line's nearest crossing; false when it has none.
bool alongLine(const SliceView& view, int line, std::vector<float>& squared) {
  std::fill(squared.begin(), squared.end(), kNone);
  bool any = false;
  const auto lower = [&](int s, float distance) {
    float& d = squared[static_cast<std::size_t>(s)];
    d = std::min(d, distance);
  };
  float last = -kNone;
  for (int s = 0; s < view.n; ++s) {
    lower(s, static_cast<float>(s) - last);
    if (s + 1 < view.n && view.inside(s, line) != view.inside(s + 1, line)) {
      const float here = view.value(s, line);
      last = static_cast<float>(s) + here / (here - view.value(s + 1, line));
      any = true;
    }
  }
  float next = kNone;
  for (int s = view.n - 1; s >= 0; --s) {
    lower(s, next - static_cast<float>(s));
    if (s > 0 && view.inside(s, line) != view.inside(s - 1, line)) {
      const float before = view.value(s - 1, line);
      next = static_cast<float>(s - 1) + before / (before - view.value(s, line));
    }
  }
  for (float& d : squared) d = d * d * view.along * view.along;
  return any;
}

/// Lower envelope of the parabolas f_l + (h (x - l))^2 over lines l.
class Envelope {
 public:
  Envelope(int samples, float spacing) : squaredSpacing_(spacing * spacing) {
    pieces_.resize(static_cast<std::size_t>(samples) + 1);
    for (int d = 0; d < samples; ++d) halfInverse_.push_back(0.5 / d);
  }

  /// Writes min_l into out[x] for all x, with f[n] the parabola's foot at lines[n], ascending.
  void lower(const std::vector<int>& lines, const std::vector<float>& f, std::vector<float>& out) {
    const double perSquare = 1 / squaredSpacing_;
    std::size_t count = 0;
    for (std::size_t n = 0; n < lines.size(); ++n) {
      const int l = lines[n];
      const double height = f[n] * perSquare + double{1} * l * l;
      double cut = -kNone;
      // l takes over from line v where  height_l - 2 x l = height_v - 2 x v.
      for (; count > 0; --count) {
        const Piece& last = pieces_[count - 1];
        cut = (height - last.height) * halfInverse_[static_cast<std::size_t>(l - last.line)];
        if (cut > last.from) break;
      }
      pieces_[count] = {l, f[n], height, count > 0 ? cut : -kNone};
      ++count;
    }
    pieces_[count].from = kNone;
    const int samples = static_cast<int>(out.size());
    for (std::size_t p = 0, x = 0; p < count; ++p) {
      const double next = pieces_[p + 1].from;  // where it begins the two are equal
      const auto end = static_cast<std::size_t>(next < samples ? std::max(std::ceil(next), 0.0) : samples);
      for (; x < end; ++x) {
        const float away = static_cast<float>(static_cast<int>(x) - pieces_[p].line);
        out[x] = pieces_[p].foot + squaredSpacing_ * away * away;
      }
    }
  }

 private:
  struct Piece {
    int line;
    float foot;
    double height, from;  ///< foot + line^2 in squared spacings; where the piece begins
  };
  float squaredSpacing_;
  std::vector<Piece> pieces_;
  std::vector<double> halfInverse_;  ///< 1 / (2 d)
};

/// Lowers `squared` (laid out like the slice) to the squared distance from the crossings on the view's lines.
void lowerToCrossings(const SliceView& view, std::vector<float>& squared) {
  std::vector<int> lines;
  std::vector<float> table;  // line after line
  std::vector<float> line(static_cast<std::size_t>(view.n));
  for (int l = 0; l < view.lines; ++l) {
    if (!alongLine(view, l, line)) continue;
    lines.push_back(l);
    table.insert(table.end(), line.begin(), line.end());
  }
  if (lines.empty()) return;
  Envelope envelope(view.lines, view.across);
  std::vector<float> f(lines.size()), out(static_cast<std::size_t>(view.lines));
  for (int s = 0; s < view.n; ++s) {
    for (std::size_t n = 0; n < lines.size(); ++n)
      f[n] = table[n * line.size() + static_cast<std::size_t>(s)];
    envelope.lower(lines, f, out);
    for (int l = 0; l < view.lines; ++l) {
      float& d = squared[static_cast<std::size_t>(s * view.step + l * view.next)];
      d = std::min(d, out[static_cast<std::size_t>(l)]);
    }
  }
}

using Point = Eigen::Vector2f;

float squaredDistance(const Point& x, const Point& a, const Point& b) {
  const Point edge = b - a;
  const float length = edge.squaredNorm();
  const float t = length > 0 ? std::clamp((x - a).dot(edge) / length, 0.0F, 1.0F) : 0.0F;
  return (x - a - t * edge).squaredNorm();
}

/// The contour's pieces in the cell whose lower corner is pixel (i,j), given to visit(a, b), in mm.
template <typename Visit>
void contourPieces(const SliceView& view, int i, int j, const Visit& visit) {
  constexpr std::array<std::array<int, 2>, 4> kCorner{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  std::array<Point, 4> crossing;
  std::size_t count = 0;
  float sum = 0;
  for (std::size_t e = 0; e < 4; ++e) {
    const auto& p = kCorner[e];
    const auto& q = kCorner[(e + 1) % 4];
    const float here = view.value(i + p[0], j + p[1]), there = view.value(i + q[0], j + q[1]);
    sum += here;
    if ((here < 0) == (there < 0)) continue;
    const float t = here / (here - there);
    crossing[count++] =
        Point((static_cast<float>(i + p[0]) + t * static_cast<float>(q[0] - p[0])) * view.along,
              (static_cast<float>(j + p[1]) + t * static_cast<float>(q[1] - p[1])) * view.across);
  }
  if (count == 2) visit(crossing[0], crossing[1]);
  if (count < 4) return;
  // A saddle: the mean of the corners tells whether the two corners like corner 0 are joined.
  const bool joined = (sum < 0) == view.inside(i, j);
  visit(crossing[0], crossing[joined ? 1 : 3]);
  visit(crossing[2], crossing[joined ? 3 : 1]);
}

/// Lowers `squared` within kReach pixels of the contour to the distance from its straight pieces.
void lowerToPieces(const SliceView& view, std::vector<float>& squared) {
  constexpr int kReach = 3;
  for (int j = 0; j + 1 < view.lines; ++j)
    for (int i = 0; i + 1 < view.n; ++i) {
      const bool corner = view.inside(i, j);
      if (corner == view.inside(i + 1, j) && corner == view.inside(i, j + 1) &&
          corner == view.inside(i + 1, j + 1))
        continue;
      contourPieces(view, i, j, [&](const Point& a, const Point& b) {
        for (int y = std::max(0, j + 1 - kReach); y <= std::min(view.lines - 1, j + kReach); ++y)
          for (int x = std::max(0, i + 1 - kReach); x <= std::min(view.n - 1, i + kReach); ++x) {
            const Point at(static_cast<float>(x) * view.along, static_cast<float>(y) * view.across);
            float& d = squared[static_cast<std::size_t>(x + y * view.next)];
            d = std::min(d, squaredDistance(at, a, b));
          }
      });
    }
}

}  // namespace

void sliceDistances(DenseField& field, const Eigen::Vector2d& pixel, double limit) {
  if (!(pixel.array() > 0).all() || !(limit > 0))
    throw std::invalid_argument("sliceDistances: pixel and limit must be positive");
  const int nx = field.size.x(), ny = field.size.y();
  const Eigen::Vector2f h = pixel.cast<float>();
  const auto bound = static_cast<float>(limit);
  tbb::parallel_for(0, field.size.z(), [&](int k) {
    float* slice = field.row(0, k);
    const SliceView rows{slice, nx, ny, 1, nx, h.x(), h.y()};
    const SliceView columns{slice, ny, nx, nx, 1, h.y(), h.x()};
    std::vector<float> squared(field.index(0, 0, 1), kNone);
    lowerToCrossings(rows, squared);
    lowerToCrossings(columns, squared);
    lowerToPieces(rows, squared);
    for (std::size_t s = 0; s < squared.size(); ++s) {
      const float distance = std::min(std::sqrt(squared[s]), bound);
      slice[s] = slice[s] < 0 ? -distance : distance;
    }
  });
}

}  // namespace sinew
