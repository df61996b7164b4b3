#pragma once

#include "sinew/MeshIO/TissueMesh.h"

#include <Eigen/Geometry>

#include <ostream>
#include <string>

namespace sinew {

/// What `sinew info` says of a mesh.
struct MeshInfo {
  struct Region {
    TissueRegion tissue;
    std::int64_t tets = 0;
    double volume = 0;                                   ///< mm^3
    Eigen::Vector3d centroid = Eigen::Vector3d::Zero();  ///< of the volume, LPS mm
  };
  std::string file;
  std::int64_t nodes = 0, tets = 0;
  Eigen::AlignedBox3d box;      ///< LPS mm
  std::vector<Region> regions;  ///< in the order of the file
};

/// @throws std::runtime_error naming the file when it cannot be read
MeshInfo describeMesh(const std::string& file);

std::string toJson(const MeshInfo& mesh);
void print(std::ostream& stream, const MeshInfo& mesh);

}  // namespace sinew
