#include "ShapeEngine.h"

#include <algorithm>

namespace sinew::repair {
namespace {

class EstimatingEngine : public ShapeEngine {
 public:
  using ShapeEngine::ShapeEngine;

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
      shape.volume = std::min({a->volume, b->volume, shape.box.volume()});
    }
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

  std::vector<ShapePtr> components(const ShapePtr& shape) override { return {shape}; }

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
  static ShapePtr made(Shape shape) { return std::make_shared<const Shape>(std::move(shape)); }
};

}  // namespace

std::unique_ptr<ShapeEngine> makeEstimatingEngine(const Segmentation& input) {
  return std::make_unique<EstimatingEngine>(input);
}

}  // namespace sinew::repair
