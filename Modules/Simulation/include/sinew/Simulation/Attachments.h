#pragma once

#include <cstdint>
#include <vector>

namespace sinew {

/// The nodes by which a mesh is held: those of a muscle's origin and insertion, or its two ends. No node is
/// in both.
struct Attachments {
  std::vector<std::int32_t> origin, insertion;
};

}  // namespace sinew
