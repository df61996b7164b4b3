#include "SliceGap.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sinew {
namespace {

constexpr double kTolerated = 0.15;  ///< deviation of a ramp's mean height from one half that is left alone
constexpr int kSkirt = 3;            ///< pixels around a limited piece whose distances must fit to it
constexpr std::array<std::array<int, 2>, 8> kNeighbours{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

/// A connected piece of the area that is tissue on one slice and background on the other.
struct ChangingPiece {
  std::vector<int> pixels;
  bool meetsTissue = false;      ///< borders on pixels that are tissue on both slices
  bool meetsBackground = false;  ///< borders on pixels that are background on both slices
};

class GapBalancer {
 public:
  GapBalancer(SliceGap& gap, const float* before, const float* after, double rounding)
      : gap_(gap),
        before_(before),
        after_(after),
        rounding_(rounding),
        seen_(gap.lower.size(), 0),
        bridged_(gap.lower.size(), 0) {}

  void run() {
    const int pixels = static_cast<int>(gap_.lower.size());
    for (int p = 0; p < pixels; ++p)
      if (isTissue(p) && !seen_[static_cast<std::size_t>(p)]) bridge(collectRegion(p));
    seen_ = bridged_;
    for (int p = 0; p < pixels; ++p)
      if (changes(p) && !seen_[static_cast<std::size_t>(p)]) limit(collectPiece(p));
  }

 private:
  float lower(int p) const { return gap_.lower[static_cast<std::size_t>(p)]; }
  float upper(int p) const { return gap_.upper[static_cast<std::size_t>(p)]; }
  bool changes(int p) const { return (lower(p) < 0) != (upper(p) < 0); }
  bool isTissue(int p) const { return lower(p) < 0 || upper(p) < 0; }

  template <typename Visit>
  void neighbours(int p, const Visit& visit) const {
    const int x = p % gap_.nx, y = p / gap_.nx;
    for (const auto& [dx, dy] : kNeighbours)
      if (x + dx >= 0 && x + dx < gap_.nx && y + dy >= 0 && y + dy < gap_.ny) visit(p + dx + dy * gap_.nx);
  }

  ChangingPiece collectPiece(int start) {
    ChangingPiece piece;
    const bool lowerInside = lower(start) < 0;
    piece.pixels.push_back(start);
    seen_[static_cast<std::size_t>(start)] = 1;
    for (std::size_t next = 0; next < piece.pixels.size(); ++next)
      neighbours(piece.pixels[next], [&](int n) {
        if (!changes(n)) {
          (lower(n) < 0 ? piece.meetsTissue : piece.meetsBackground) = true;
        } else if (!seen_[static_cast<std::size_t>(n)] && (lower(n) < 0) == lowerInside) {
          seen_[static_cast<std::size_t>(n)] = 1;
          piece.pixels.push_back(n);
        }
      });
    return piece;
  }

  /// The connected pixels that are tissue on either slice.
  std::vector<int> collectRegion(int start) {
    std::vector<int> region{start};
    seen_[static_cast<std::size_t>(start)] = 1;
    for (std::size_t next = 0; next < region.size(); ++next)
      neighbours(region[next], [&](int n) {
        if (!isTissue(n) || seen_[static_cast<std::size_t>(n)]) return;
        seen_[static_cast<std::size_t>(n)] = 1;
        region.push_back(n);
      });
    return region;
  }

  /// A thin part that runs aslant leaves two patches that touch or hardly overlap. The sum of their distances
  /// is low between them: bulge = the value that gives the shape  (lower + upper) / 2 < bulge  their mean
  /// area.
  void bridge(const std::vector<int>& region) {
    constexpr double kOverlap = 0.3, kLikeness = 4;
    constexpr int kSurroundings = 4;  // pixels
    std::size_t below = 0, above = 0, both = 0;
    for (const int p : region) {
      below += lower(p) < 0;
      above += upper(p) < 0;
      both += !changes(p);
    }
    const auto [smaller, larger] = std::minmax(below, above);
    if (static_cast<double>(both) >= kOverlap * static_cast<double>(smaller) ||
        static_cast<double>(larger) > kLikeness * static_cast<double>(smaller))
      return;

    const std::vector<int> area = withSurroundings(region, kSurroundings);
    std::vector<float> middle;
    for (const int p : area) middle.push_back((lower(p) + upper(p)) / 2);
    const auto wanted = middle.begin() + static_cast<std::ptrdiff_t>((below + above) / 2);
    std::nth_element(middle.begin(), wanted, middle.end());
    if (gap_.bulge.empty()) gap_.bulge.assign(gap_.lower.size(), 0);
    for (const int p : area) {
      gap_.bulge[static_cast<std::size_t>(p)] = std::max(*wanted, 0.0F);
      gap_.limited[static_cast<std::size_t>(p)] = 1;
    }
    for (const int p : region) bridged_[static_cast<std::size_t>(p)] = 1;
  }

  /// A region and the background pixels around it.
  std::vector<int> withSurroundings(const std::vector<int>& region, int rings) {
    std::vector<int> area = region;
    std::size_t ringBegin = 0;
    for (int ring = 0; ring < rings; ++ring) {
      const std::size_t ringEnd = area.size();
      for (; ringBegin < ringEnd; ++ringBegin)
        neighbours(area[ringBegin], [&](int n) {
          if (isTissue(n) || seen_[static_cast<std::size_t>(n)]) return;
          seen_[static_cast<std::size_t>(n)] = 1;
          area.push_back(n);
        });
    }
    for (std::size_t n = region.size(); n < area.size(); ++n) seen_[static_cast<std::size_t>(area[n])] = 0;
    return area;
  }

  void limit(const ChangingPiece& piece) {
    if (!piece.meetsTissue) {
      capPiece(piece, true);
    } else if (!piece.meetsBackground) {
      capPiece(piece, false);
    } else {
      limitRamp(piece);
    }
  }

  /// Distance on the slice where the pixel is tissue (inside = true) or where it is background.
  float& distanceOn(int p, bool inside) {
    return ((lower(p) < 0) == inside ? gap_.lower : gap_.upper)[static_cast<std::size_t>(p)];
  }

  /// Mean height of a cap, as a part of the gap: half of it, what the voxels say, when the contour does not
  /// change towards the cap. When it shrinks, the end is that of the paraboloid through the last two
  /// contours,
  ///     height = s^2 / (t^2 - s^2)  gaps,  half of it on average,
  /// with s and t the depths of the piece's deepest pixel on its own slice and on the one before.
  double capHeight(const ChangingPiece& piece, bool tissue) {
    constexpr double kLeast = 0.1, kMost = 0.5;
    int deepest = piece.pixels.front();
    for (const int p : piece.pixels)
      if (std::abs(distanceOn(p, tissue)) > std::abs(distanceOn(deepest, tissue))) deepest = p;
    const bool onLower = (lower(deepest) < 0) == tissue;
    const float before = (onLower ? before_ : after_)[deepest];
    const double own = distanceOn(deepest, tissue);
    const double s2 = own * own, t2 = (before < 0) == (own < 0) ? double{before} * before : 0;
    return t2 <= s2 ? kMost : std::clamp(0.5 * s2 / (t2 - s2), kLeast, kMost);
  }

  /// Ends a piece: with the depth s = min(|d|, rounding) below the rim and a constant c on the other slice
  /// the surface is at the height s / (s + c) of the gap; c is chosen for the mean height.
  /// @param tissue  the piece is tissue without counterpart; else it is a hole without one
  void capPiece(const ChangingPiece& piece, bool tissue) {
    const double height = capHeight(piece, tissue);
    std::vector<double> depth;
    for (const int p : piece.pixels)
      depth.push_back(std::min<double>(std::abs(distanceOn(p, tissue)), rounding_));
    const auto meanHeight = [&](double c) {
      double sum = 0;
      for (const double s : depth) sum += s / (s + c);
      return sum / static_cast<double>(depth.size());
    };
    double low = 1e-4 * rounding_, high = 1e2 * rounding_;
    for (int step = 0; step < 30; ++step) {
      const double middle = std::sqrt(low * high);
      (meanHeight(middle) > height ? low : high) = middle;
    }
    const auto opposite = static_cast<float>(std::sqrt(low * high));
    const float sign = tissue ? -1.0F : 1.0F;
    for (std::size_t n = 0; n < piece.pixels.size(); ++n) {
      const int p = piece.pixels[n];
      distanceOn(p, tissue) = sign * static_cast<float>(depth[n]);
      distanceOn(p, !tissue) = -sign * opposite;
      gap_.limited[static_cast<std::size_t>(p)] = 1;
    }
    limitSkirt(piece, opposite);
  }

  /// Clamps both distances to the largest bound 2^-n that brings the mean height near one half.
  void limitRamp(const ChangingPiece& piece) {
    double bound = 0;
    for (const int p : piece.pixels)
      bound = std::max<double>(bound, std::max(std::abs(lower(p)), std::abs(upper(p))));
    const auto meanHeight = [&] {
      double sum = 0;
      for (const int p : piece.pixels) {
        const double s = std::min<double>(std::abs(distanceOn(p, true)), bound),
                     o = std::min<double>(std::abs(distanceOn(p, false)), bound);
        sum += s + o > 0 ? s / (s + o) : 0.5;
      }
      return sum / static_cast<double>(piece.pixels.size());
    };
    const double widest = bound;
    while (std::abs(meanHeight() - 0.5) > kTolerated && bound > rounding_) bound /= 2;
    if (bound == widest) return;
    const auto limit = static_cast<float>(bound);
    for (const int p : piece.pixels) {
      for (const bool inside : {true, false})
        distanceOn(p, inside) = std::clamp(distanceOn(p, inside), -limit, limit);
      gap_.limited[static_cast<std::size_t>(p)] = 1;
    }
    limitSkirt(piece, limit);
  }

  /// Around a piece, on pixels that do not change: |far| <= bound + |near|, so that the field has no step
  /// there.
  void limitSkirt(const ChangingPiece& piece, float bound) {
    std::vector<int> ring = piece.pixels, next;
    for (int round = 0; round < kSkirt; ++round) {
      next.clear();
      for (const int p : ring)
        neighbours(p, [&](int n) {
          if (changes(n) || gap_.limited[static_cast<std::size_t>(n)]) return;
          gap_.limited[static_cast<std::size_t>(n)] = 1;
          next.push_back(n);
          float &a = gap_.lower[static_cast<std::size_t>(n)], &b = gap_.upper[static_cast<std::size_t>(n)];
          float& far = std::abs(a) > std::abs(b) ? a : b;
          const float limit = bound + std::min(std::abs(a), std::abs(b));
          far = std::clamp(far, -limit, limit);
        });
      ring.swap(next);
    }
  }

  SliceGap& gap_;
  const float *before_, *after_;
  double rounding_;
  std::vector<std::uint8_t> seen_, bridged_;
};

}  // namespace

SliceGap::SliceGap(const float* lowerSlice, const float* upperSlice, int nx_, int ny_)
    : nx(nx_),
      ny(ny_),
      lower(lowerSlice, lowerSlice + std::ptrdiff_t{nx_} * ny_),
      upper(upperSlice, upperSlice + std::ptrdiff_t{nx_} * ny_),
      limited(lower.size(), 0) {}

void SliceGap::balance(const float* before, const float* after, double rounding) {
  GapBalancer(*this, before, after, rounding).run();
}

}  // namespace sinew
