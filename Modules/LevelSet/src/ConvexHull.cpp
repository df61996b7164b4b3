#include "sinew/LevelSet/Solid.h"

extern "C" {
#include <libqhull_r/libqhull_r.h>
}

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// A face of the hull: inside  normal.x + offset < 0.
struct Face {
  Vector3d normal;
  double offset;
};

/// A run of Qhull, with all that it allocates. It complains to a FILE only, which nobody reads.
class Hull {
 public:
  explicit Hull(std::vector<Vector3d> points) : points_(std::move(points)) {
    if (!silence_) throw std::runtime_error("convexHull: /dev/null cannot be written");
    QHULL_LIB_CHECK
    qh_zero(&qh_, silence_.get());
    std::string command = "qhull Pp";  // no warnings about precision
    failure_ = qh_new_qhull(&qh_, 3, static_cast<int>(points_.size()), points_.front().data(), False,
                            command.data(), nullptr, silence_.get());
  }
  ~Hull() {
    qh_freeqhull(&qh_, !qh_ALL);
    int left = 0, leftInUse = 0;
    qh_memfreeshort(&qh_, &left, &leftInUse);
  }
  Hull(const Hull&) = delete;
  Hull& operator=(const Hull&) = delete;

  bool failed() const { return failure_ != 0; }

  std::vector<Face> faces() const {
    std::vector<Face> all;
    for (const facetT* face = qh_.facet_list; face != nullptr && face->next != nullptr; face = face->next)
      all.push_back({Vector3d(face->normal[0], face->normal[1], face->normal[2]), face->offset});
    return all;
  }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::vector<Vector3d> points_;  ///< Qhull keeps pointers to them
  std::unique_ptr<std::FILE, Close> silence_{std::fopen("/dev/null", "w")};
  qhT qh_;
  int failure_ = 0;
};

}  // namespace

Solid convexHull(const std::vector<Vector3d>& points) {
  if (points.size() < 4)
    throw std::invalid_argument("convexHull: needs at least four points, got " +
                                std::to_string(points.size()));
  Eigen::AlignedBox3d bounds;
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (!points[n].allFinite())
      throw std::invalid_argument("convexHull: point " + std::to_string(n) + " must be finite");
    bounds.extend(points[n]);
  }
  // About the middle of the points, where the offsets of the faces lose least to rounding.
  const Vector3d middle = bounds.center();
  std::vector<Vector3d> centred;
  for (const Vector3d& point : points) centred.push_back(point - middle);
  const Hull hull(std::move(centred));
  if (hull.failed()) throw std::invalid_argument("convexHull: the points must not lie in a plane");
  const auto phi = [faces = hull.faces(), middle](const Vector3d& x) {
    double most = -std::numeric_limits<double>::infinity();
    for (const Face& face : faces) most = std::max(most, face.normal.dot(x - middle) + face.offset);
    return most;
  };
  return {phi, bounds, false};
}

}  // namespace sinew
