#pragma once

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace sinew {

/// One tissue of a phantom as a set of points, LPS mm.
struct PhantomPart {
  std::int32_t label;
  std::string name;
  std::array<double, 3> color;
  std::function<bool(const Eigen::Vector3d& x)> contains;
  int layer = 0;
};

/// An analytic phantom: where parts of a layer overlap, the one listed first has the point.
struct PhantomShape {
  std::string name;
  std::string description;
  Eigen::AlignedBox3d region;  ///< holds every part with room to spare, mm
  Eigen::Vector3d spacing;     ///< of its own scan, mm
  double tiltDeg;              ///< of its own scan
  std::vector<PhantomPart> parts;
};

/// Those that lack something, each with a repair script of its name.
std::vector<PhantomShape> damagedPhantoms();

/// All phantoms, in the order of the help text.
const std::vector<PhantomShape>& phantomShapes();

}  // namespace sinew
