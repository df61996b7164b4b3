#pragma once

#include "sinew/Elasticity/ElasticBody.h"

namespace sinew {

/// A direction for every tet, from one attachment of a muscle to the other: grad u / |grad u| of the harmonic
/// field u that is 0 at the origin and 1 at the insertion, and through whose other boundary nothing flows.
/// Fibres end at the attachments only and do not cross.
/// @param origin, insertion  nodes; others are free
/// @return unit vectors; zero in tets where u does not change, such as pieces without an attachment
/// @throws std::invalid_argument when one of them is empty, holds a node that the body has not, or both hold
/// the same
/// Cost: one solution of a sparse system of the nodes by conjugate gradients.
/// Source: Choi and Blemker 2013, Skeletal muscle fascicle arrangements can be reconstructed using a
/// Laplacian vector field simulation, PLoS ONE 8(10).
NodeVectors harmonicFibres(const ElasticBody& body, const std::vector<std::int32_t>& origin,
                           const std::vector<std::int32_t>& insertion);

}  // namespace sinew
