#include "sinew/Segmentation/Phantom.h"

#include "PhantomShapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

namespace sinew {
namespace {

/// More is a slip of the keyboard: 8 GB of labels.
constexpr double kMaxVoxels = 2e9;

const PhantomShape& shapeNamed(const std::string& name) {
  const auto& shapes = phantomShapes();
  if (const auto found = std::ranges::find(shapes, name, &PhantomShape::name); found != shapes.end())
    return *found;
  std::string known;
  for (const PhantomShape& shape : shapes) known += (known.empty() ? "" : ", ") + shape.name;
  throw std::invalid_argument("no phantom is called '" + name + "'; there are " + known);
}

void check(const Eigen::Vector3d& spacing, double tiltDeg, double noise) {
  if (!spacing.allFinite() || (spacing.array() <= 0).any())
    throw std::invalid_argument("phantom: the spacing must be above 0 mm");
  if (!std::isfinite(tiltDeg)) throw std::invalid_argument("phantom: the tilt must be a finite angle");
  if (!(noise >= 0 && noise <= 1))
    throw std::invalid_argument("phantom: the noise is " + std::to_string(noise) + ", it must be in [0, 1]");
}

/// The smallest grid of tilted voxels about the region's centre that covers the region.
ImageGeometry scanOf(const Eigen::AlignedBox3d& region, const Eigen::Vector3d& spacing, double tiltDeg) {
  const Eigen::Vector3d axis = Eigen::Vector3d(3, 2, 1).normalized();
  ImageGeometry scan;
  scan.direction = Eigen::AngleAxisd(tiltDeg * std::numbers::pi / 180, axis).toRotationMatrix();
  scan.spacing = spacing;
  const Eigen::Vector3d extent = scan.direction.cwiseAbs().transpose() * region.sizes();
  constexpr double rounding = 1e-9;  // voxels: a region of whole voxels gets no further one
  const Eigen::Vector3d size = (extent.cwiseQuotient(spacing).array() - rounding).ceil().max(1);
  if (size.prod() > kMaxVoxels)
    throw std::invalid_argument("phantom: at this spacing it has more than 2000 million voxels");
  scan.size = size.cast<int>();
  scan.origin = region.center() - scan.direction * spacing.cwiseProduct(size - Eigen::Vector3d::Ones()) / 2;
  return scan;
}

std::int32_t labelAt(const PhantomShape& shape, int layer, const Eigen::Vector3d& x) {
  if (!shape.region.contains(x)) return 0;
  const auto part = std::ranges::find_if(
      shape.parts, [&](const PhantomPart& p) { return p.layer == layer && p.contains(x); });
  return part == shape.parts.end() ? 0 : part->label;
}

std::vector<std::int32_t> sample(const PhantomShape& shape, int layer, const ImageGeometry& scan) {
  const Eigen::Affine3d toPhysical = scan.indexToPhysical();
  std::vector<std::int32_t> voxels;
  voxels.reserve(scan.voxelCount());
  for (int k = 0; k < scan.size.z(); ++k)
    for (int j = 0; j < scan.size.y(); ++j)
      for (int i = 0; i < scan.size.x(); ++i)
        voxels.push_back(labelAt(shape, layer, toPhysical * Eigen::Vector3d(i, j, k)));
  return voxels;
}

/// Gives surface voxels (a face neighbour differs) the label of one differing neighbour, both by lot.
/// Only raw numbers of the generator are used: the standard fixes them, but not its distributions.
void addNoise(std::vector<std::int32_t>& voxels, const Eigen::Vector3i& size, double fraction,
              std::uint32_t seed) {
  const std::vector<std::int32_t> clean = voxels;
  const std::array<std::int64_t, 3> stride{1, size.x(), std::int64_t{size.x()} * size.y()};
  const double threshold = fraction * 4294967296.0;  // of 2^32 outcomes
  std::mt19937 random(seed);
  std::int64_t at = 0;
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i, ++at) {
        std::array<std::int32_t, 6> others{};
        std::uint32_t count = 0;
        const Eigen::Vector3i index(i, j, k);
        for (int axis = 0; axis < 3; ++axis) {
          if (index[axis] > 0) others[count++] = clean[at - stride[axis]];
          if (index[axis] + 1 < size[axis]) others[count++] = clean[at + stride[axis]];
        }
        const auto same = std::remove(others.begin(), others.begin() + count, clean[at]);
        count = static_cast<std::uint32_t>(same - others.begin());
        if (count > 0 && random() < threshold) voxels[at] = others[random() % count];
      }
}

}  // namespace

const std::vector<PhantomInfo>& phantoms() {
  static const std::vector<PhantomInfo> infos = [] {
    std::vector<PhantomInfo> all;
    for (const PhantomShape& shape : phantomShapes()) all.push_back({shape.name, shape.description});
    return all;
  }();
  return infos;
}

Segmentation makePhantom(const std::string& name, const PhantomOptions& options) {
  const PhantomShape& shape = shapeNamed(name);
  const Eigen::Vector3d spacing = options.spacing.value_or(shape.spacing);
  const double tiltDeg = options.tiltDeg.value_or(shape.tiltDeg);
  check(spacing, tiltDeg, options.noise);

  Segmentation phantom;
  phantom.source = "phantom " + name;
  phantom.geometry = scanOf(shape.region, spacing, tiltDeg);
  const int layers = std::ranges::max(shape.parts, {}, &PhantomPart::layer).layer + 1;
  for (int layer = 0; layer < layers; ++layer) {
    phantom.layers.push_back(sample(shape, layer, phantom.geometry));
    if (options.noise > 0)
      addNoise(phantom.layers[layer], phantom.geometry.size, options.noise, options.seed);
  }
  for (const PhantomPart& part : shape.parts) {
    Tissue& tissue = phantom.tissues.emplace_back();
    tissue.name = tissue.id = part.name;
    tissue.label = part.label;
    tissue.layer = part.layer;
    tissue.color = part.color;
    tissue.named = true;
  }
  updateTissueTable(phantom);
  return phantom;
}

}  // namespace sinew
