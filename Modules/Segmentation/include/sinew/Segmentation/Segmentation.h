#pragma once

#include "sinew/Segmentation/ImageGeometry.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace sinew {

/// Half-open box of voxel indices, lower <= i < upper. Empty by default.
struct VoxelBox {
  Eigen::Vector3i lower = Eigen::Vector3i::Zero();
  Eigen::Vector3i upper = Eigen::Vector3i::Zero();
  bool empty() const { return (upper.array() <= lower.array()).any(); }
};

/// One tissue of a segmentation: the voxels of layer `layer` whose value is `label`.
/// Two tissues may share a label on different layers, and tissues of different layers may overlap.
struct Tissue {
  std::string name;                               ///< anatomical name; `Segment_<label>` where the file has none
  std::string id;                                 ///< Slicer's SegmentN_ID, or the name
  int layer = 0;                                  ///< 0-based component of a layered file
  std::int32_t label = 0;                         ///< voxel value, never 0
  std::array<double, 3> color{0.5, 0.5, 0.5};     ///< RGB in 0..1
  bool named = false;                             ///< the name came from the file or a table
  std::map<std::string, std::string> tags;        ///< Slicer's SegmentN_Tags
  std::int64_t voxels = 0;                        ///< how many voxels it has
  VoxelBox box;                                   ///< smallest box that holds them
};

/// A labelled volume: one or more layers of label values on one geometry, and the table of its tissues.
struct Segmentation {
  ImageGeometry geometry;
  std::vector<std::vector<std::int32_t>> layers;  ///< [layer][i + size.x * (j + size.y * k)]; 0 is background
  std::vector<Tissue> tissues;                    ///< by layer, then label; only tissues that have voxels
  std::vector<Tissue> emptyTissues;               ///< named in the file's own table, but without a voxel
  std::string source;                             ///< path it was read from, for messages
  std::map<std::string, std::string> keys;        ///< Slicer's keys of the file as a whole, carried through

  std::int32_t at(int layer, const Eigen::Vector3i& index) const;
};

/// A bright colour for a label, RGB in 0..1: neighbouring labels get hues far apart.
std::array<double, 3> labelColor(std::int32_t label);

/// Rebuilds voxels and boxes of the tissue table from the layers: values without an entry get one named
/// `Segment_<value>` (`Segment_<value>_layer_<n>` above layer 0) with a colour of its own, entries without voxels move to `emptyTissues`.
/// Cost: O(voxels).
void updateTissueTable(Segmentation& segmentation);

}  // namespace sinew
