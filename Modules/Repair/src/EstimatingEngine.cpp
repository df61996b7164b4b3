#include "ShapeEngine.h"
#include "sinew/Segmentation/LabelComponents.h"

#include <algorithm>

namespace sinew::repair {
namespace {

std::vector<VoxelBox> boxesOf(const LabelComponents& pieces) {
  const Eigen::Vector3i size = pieces.box.upper - pieces.box.lower;
  std::vector<Eigen::AlignedBox3i> boxes(pieces.voxels.size());
  const std::int32_t* id = pieces.ids.data();
  for (int k = 0; k < size.z(); ++k)
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i, ++id)
        if (*id >= 0) boxes[static_cast<std::size_t>(*id)].extend(Eigen::Vector3i(i, j, k));
  std::vector<VoxelBox> result;
  for (const Eigen::AlignedBox3i& box : boxes)
    result.push_back({pieces.box.lower + box.min(), pieces.box.lower + box.max() + Eigen::Vector3i::Ones()});
  return result;
}

class EstimatingEngine : public ShapeEngine {
 public:
  explicit EstimatingEngine(const Segmentation& input)
      : ShapeEngine(input),
        image_(physicalBox(input.geometry, {Eigen::Vector3i::Zero(), input.geometry.size})) {}

  ShapePtr mesh(const TriangleMesh& mesh) override {
    Shape shape;
    for (const Eigen::Vector3d& node : mesh.nodes) shape.box.extend(node);
    shape.volume = shape.box.volume();
    return made(std::move(shape));
  }

  ShapePtr combined(Csg operation, const ShapePtr& a, const ShapePtr& b, double) override {
    Shape shape = descendant(a, b);
    shape.box = a->box;
    shape.volume = a->volume;
    if (operation == Csg::Union) {
      shape.box.extend(b->box);
      shape.volume += b->volume;
    } else if (operation == Csg::Intersection) {
      shape.box = a->box.intersection(b->box);
      shape.volume = shape.box.isEmpty() ? 0 : std::min({a->volume, b->volume, shape.box.volume()});
    }
    clipToImage(shape, a, b);
    return made(std::move(shape));
  }

  ShapePtr changed(const ShapePtr& parent, const Change& change) override {
    Shape shape = descendant(parent);
    shape.box = parent->box;
    shape.box.min().array() -= change.growth;
    shape.box.max().array() += change.growth;
    shape.volume = parent->volume;
    return made(std::move(shape));
  }

  /// Of a tissue as it was read the pieces of its voxels; of others, the whole.
  std::vector<ShapePtr> components(const ShapePtr& shape) override {
    if (!shape->untouched) return {shape};
    const Tissue& tissue = input_.tissues[static_cast<std::size_t>(shape->origin)];
    const LabelComponents pieces = labelComponents(input_, tissue);
    const std::vector<VoxelBox> boxes = boxesOf(pieces);
    std::vector<ShapePtr> shapes;
    for (std::size_t p = 0; p < boxes.size(); ++p) {
      Shape piece = descendant(shape);
      piece.box = physicalBox(input_.geometry, boxes[p]);
      piece.volume = static_cast<double>(pieces.voxels[p]) * input_.geometry.voxelVolume();
      shapes.push_back(made(std::move(piece)));
    }
    return shapes;
  }

  ShapePtr moved(const ShapePtr& parent, const Eigen::Affine3d& motion) override {
    if (parent->solid) return solid(sinew::moved(*parent->solid, motion), parent->blend);
    Shape shape;
    shape.name = parent->name;
    shape.box = parent->box.transformed(motion);
    shape.volume = parent->volume * std::abs(motion.linear().determinant());
    return made(std::move(shape));
  }

  double volume(const ShapePtr& shape) override { return shape->volume; }
  std::optional<ShapeSummary> summary(const ShapePtr&) override { return std::nullopt; }
  Eigen::AlignedBox3d bounds(const ShapePtr& shape) override { return shape->box; }
  Eigen::Vector3d centroid(const ShapePtr& shape) override { return shape->box.center(); }

 private:
  /// What has no end is computed as far as the image and the other operand go.
  void clipToImage(Shape& shape, const ShapePtr& a, const ShapePtr& b) const {
    if (isFinite(shape.box)) return;
    Eigen::AlignedBox3d seen = image_;
    for (const ShapePtr& operand : {a, b})
      if (isFinite(operand->box)) seen.extend(operand->box);
    shape.box = shape.box.intersection(seen);
    shape.volume = std::min(shape.volume, shape.box.volume());
  }

  Eigen::AlignedBox3d image_;  ///< LPS mm

  static ShapePtr made(Shape shape) { return std::make_shared<const Shape>(std::move(shape)); }
};

}  // namespace

std::unique_ptr<ShapeEngine> makeEstimatingEngine(const Segmentation& input) {
  return std::make_unique<EstimatingEngine>(input);
}

}  // namespace sinew::repair
