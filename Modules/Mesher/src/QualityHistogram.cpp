#include "sinew/Mesher/QualityHistogram.h"

#include "sinew/Mesher/MeshQuality.h"

#include <algorithm>

namespace sinew {
namespace {

std::size_t dihedralBin(double degrees) {
  return std::min(static_cast<std::size_t>(degrees / kDihedralBinDeg), kDihedralBins - 1);
}

std::size_t aspectRatioBin(double aspectRatio) {
  const auto above = std::upper_bound(kAspectRatioBins.begin() + 1, kAspectRatioBins.end(), aspectRatio);
  return static_cast<std::size_t>(above - kAspectRatioBins.begin()) - 1;
}

}  // namespace

QualityHistogram qualityHistogram(const TetMesh& mesh) {
  QualityHistogram histogram;
  for (const auto& [i, j, k, l] : mesh.tets) {
    const Eigen::Vector3d &a = mesh.nodes[i], &b = mesh.nodes[j], &c = mesh.nodes[k], &d = mesh.nodes[l];
    for (const double angle : dihedralAnglesDeg(a, b, c, d)) ++histogram.dihedrals[dihedralBin(angle)];
    ++histogram.aspectRatios[aspectRatioBin(tetQuality(a, b, c, d).aspectRatio)];
  }
  return histogram;
}

}  // namespace sinew
