#pragma once

#include <openvdb/openvdb.h>

namespace sinew {

/// The only public header that includes OpenVDB: for code that works on the tree itself.
struct LevelSetGrid {
  openvdb::FloatGrid::Ptr grid;  ///< class level set, linear transform to LPS mm, background = band
};

}  // namespace sinew
