#pragma once

#include "sinew/Segmentation/Segmentation.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sinew {

struct PhantomOptions {
  std::optional<Eigen::Vector3d> spacing = {};  ///< mm; the phantom's own when empty
  std::optional<double> tiltDeg =
      {};                  ///< turn of the scan axes about an oblique axis, degrees; phantom's own
  double noise = 0;        ///< fraction of surface voxels flipped at random, in [0, 1]
  std::uint32_t seed = 1;  ///< of the noise
};

/// Name and one-line description of every phantom, in the order of the help text.
struct PhantomInfo {
  std::string name;
  std::string description;
};
const std::vector<PhantomInfo>& phantoms();

/// Samples an analytic phantom at the voxel centres.
/// @throws std::invalid_argument for an unknown name (listing the known ones), spacing <= 0, noise outside
/// [0, 1].
Segmentation makePhantom(const std::string& name, const PhantomOptions& options = {});

}  // namespace sinew
