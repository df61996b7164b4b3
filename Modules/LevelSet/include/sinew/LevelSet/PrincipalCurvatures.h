#pragma once

#include "sinew/LevelSet/DenseField.h"

namespace sinew {

/// Of the level set through a sample, 1/mm, k1 >= k2; both positive on a ball.
struct PrincipalCurvatures {
  double k1 = 0, k2 = 0;
};

/// The eigenvalues of  P H P / |grad phi|  but for the one along N:  N = grad phi / |grad phi|,
/// P = I - N N^T, H the Hessian of phi, by central differences. They are the roots of
///     k1 + k2 = tr(P H P) / |grad phi|,   k1^2 + k2^2 = |P H P|^2 / |grad phi|^2.
/// Both 0 where grad phi = 0. Beyond the raster lies the outermost sample.
/// @param phi  negative inside; smooth within one sample of `at`
/// @param spacing  of the samples along every axis, mm
/// @throws std::invalid_argument unless spacing > 0 and `at` lies in the raster.
/// Accuracy: of second order, about (spacing/radius)^2. Source: Teran et al. 2005, section 5.
PrincipalCurvatures principalCurvatures(const DenseField& phi, double spacing, const Eigen::Vector3i& at);

struct CurvatureFields {
  DenseField k1, k2;  ///< 1/mm
};

/// The same at every sample with |phi| < within, mm; 0 elsewhere. Cost: O(samples), in parallel.
CurvatureFields principalCurvatures(const DenseField& phi, double spacing, double within);

}  // namespace sinew
