#include "ShapeEngine.h"

namespace sinew::repair {

Eigen::AlignedBox3d physicalBox(const ImageGeometry& geometry, const VoxelBox& voxels) {
  const Eigen::Affine3d toPhysical = geometry.indexToPhysical();
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5);
  const Eigen::AlignedBox3d box(voxels.lower.cast<double>() - half, voxels.upper.cast<double>() - half);
  return box.transformed(toPhysical);
}

ShapePtr ShapeEngine::tissue(int index) const {
  const Tissue& tissue = input_.tissues[index];
  Shape shape;
  shape.name = tissue.name;
  shape.origin = index;
  shape.untouched = true;
  shape.box = physicalBox(input_.geometry, tissue.box);
  shape.volume = static_cast<double>(tissue.voxels) * input_.geometry.voxelVolume();
  return std::make_shared<const Shape>(std::move(shape));
}

ShapePtr ShapeEngine::solid(Solid solid, double blend) const {
  Shape shape;
  shape.box = solid.bounds;
  shape.volume = solid.bounds.volume();
  shape.distance = solid.distance;
  shape.blend = blend;
  shape.solid = std::move(solid);
  return std::make_shared<const Shape>(std::move(shape));
}

Shape descendant(const ShapePtr& a, const ShapePtr& b) {
  Shape shape;
  const ShapePtr& parent = a->name.empty() && b ? b : a;
  shape.name = parent->name;
  shape.origin = parent->origin;
  return shape;
}

}  // namespace sinew::repair
