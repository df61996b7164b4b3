#pragma once

#include "NodeStarEnergy.h"
#include "sinew/Mesher/TetBounds.h"
#include "sinew/Mesher/TetMesh.h"

#include <cstdint>
#include <vector>

namespace sinew {

/// A place that needs repair: the lattice nodes of a bad tet, or a boundary node off the surface.
struct Spot {
  std::vector<std::int32_t> nodes;
  double badness;  ///< goal measure; infinite for a node off the surface
  bool grave;      ///< must go, even at the price of other bad tets

  /// The worst first.
  bool operator<(const Spot& other) const {
    return badness != other.badness ? badness > other.badness : nodes < other.nodes;
  }
};

/// How bad a patch is: the grave spots, then a sum over the others in which the worst outweighs several that
/// are just bad.
class Badness {
 public:
  void add(const Spot& spot) {
    constexpr int kPower = 8;
    graves_ += spot.grave;
    if (!spot.grave) sum_ += power(spot.badness, kPower);
  }
  bool operator<(const Badness& other) const {
    return graves_ != other.graves_ ? graves_ < other.graves_ : sum_ < other.sum_;
  }

 private:
  int graves_ = 0;
  double sum_ = 0;
};

/// The spots of a compressed mesh.
/// @param latticeNodes  of the mesh nodes
/// @param unsnapped  mesh nodes that did not reach the surface
std::vector<Spot> repairSpots(const TetMesh& mesh, const std::vector<std::int32_t>& latticeNodes,
                              const std::vector<std::int32_t>& unsnapped, const RepairBounds& bounds);

}  // namespace sinew
