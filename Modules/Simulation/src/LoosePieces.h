#pragma once

#include "sinew/Elasticity/NodeConstraints.h"

namespace sinew {

/// What nothing holds.
struct LoosePieces {
  std::int64_t pieces = 0, tets = 0;
  std::int64_t firstTet = -1;
  std::vector<std::int32_t> nodes;
};

/// The pieces of a body, connected by nodes, without a held node. Cost: O(tets).
LoosePieces findLoosePieces(const ElasticBody& body, const NodeConstraints& constraints);

/// Whether tets lead from one of these nodes to one of those. Cost: O(tets).
bool areConnected(const ElasticBody& body, const std::vector<std::int32_t>& these,
                  const std::vector<std::int32_t>& those);

}  // namespace sinew
