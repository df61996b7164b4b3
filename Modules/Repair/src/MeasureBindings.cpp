#include "Bindings.h"

namespace sinew::repair {
namespace {

using As = Binding::As;

Value toValue(const Eigen::Vector3d& v) {
  Table table;
  for (const double number : v) table.items.emplace_back(number);
  return std::make_shared<const Table>(std::move(table));
}

Value toValue(std::vector<ShapePtr> shapes) {
  Table table;
  for (ShapePtr& shape : shapes) table.items.emplace_back(std::move(shape));
  return std::make_shared<const Table>(std::move(table));
}

Values volumeOf(Call& call) {
  call.atMost(1);
  return {call.engine().volume(call.shape(0))};
}

Values boundsOf(Call& call) {
  call.atMost(1);
  const Eigen::AlignedBox3d box = call.engine().bounds(call.shape(0));
  Table table;
  const bool ras = call.session.units().ras;
  const Eigen::Vector3d a = ras ? flipped(box.min()) : box.min(), b = ras ? flipped(box.max()) : box.max();
  table.fields["min"] = toValue(a.cwiseMin(b));
  table.fields["max"] = toValue(a.cwiseMax(b));
  table.fields["size"] = toValue((b - a).cwiseAbs());
  if (box.isEmpty()) call.reader().refuse("the shape is empty");
  return {std::make_shared<const Table>(std::move(table))};
}

Values centroidOf(Call& call) {
  call.atMost(1);
  const Eigen::Vector3d center = call.engine().centroid(call.shape(0));
  if (!center.allFinite()) call.reader().refuse("the shape is empty, or without an end");
  return {toValue(call.session.units().ras ? flipped(center) : center)};
}

Values componentsOf(Call& call) {
  call.atMost(1);
  return {toValue(call.engine().components(call.shape(0)))};
}

Values voxelSizeOf(Call& call) {
  call.atMost(0);
  return {toValue(call.session.input().geometry.spacing)};
}

constexpr Binding kMeasures[] = {
    {"volume", "volume(shape)", As::Both, volumeOf},
    {"bounds", "bounds(shape)", As::Both, boundsOf},
    {"centroid", "centroid(shape)", As::Both, centroidOf},
    {"components", "components(shape)", As::Both, componentsOf},
    {"voxel_size", "voxel_size()", As::Function, voxelSizeOf},
};

}  // namespace

std::span<const Binding> measureBindings() { return kMeasures; }

}  // namespace sinew::repair
