#include "Bindings.h"
#include "sinew/LevelSet/Offset.h"
#include "sinew/LevelSet/ShapeParts.h"
#include "sinew/LevelSet/Smooth.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

namespace sinew::repair {
namespace {

using As = Binding::As;

// + - * and their functions.

Values combinedPair(Call& call, Csg operation) {
  for (int side = 0; side < 2; ++side)
    if (!std::holds_alternative<ShapePtr>(call[side]))
      call.reader().refuse("joins two shapes; its " + std::string(side == 0 ? "left" : "right") +
                           " side is " + describe(call[side]));
  const ShapePtr &a = call.shape(0), &b = call.shape(1);
  return {call.engine().combined(operation, a, b, std::max(a->blend, b->blend))};
}

Values add(Call& call) { return combinedPair(call, Csg::Union); }
Values subtractPair(Call& call) { return combinedPair(call, Csg::Difference); }
Values multiply(Call& call) { return combinedPair(call, Csg::Intersection); }

/// f(a, b, ..., {blend=mm}): from left to right.
Values combinedAll(Call& call, Csg operation) {
  int shapes = call.count();
  std::optional<double> blend;
  if (shapes > 0 && std::holds_alternative<TablePtr>(call[shapes - 1]))
    blend = call.fields(--shapes, {"blend"}).length("blend", kNotNegative);
  if (shapes < 2) call.reader().refuse("takes two shapes or more; usage: " + call.reader().usage());
  ShapePtr result = call.shape(0);
  for (int n = 1; n < shapes; ++n) {
    const ShapePtr& next = call.shape(n);
    result =
        call.engine().combined(operation, result, next, blend.value_or(std::max(result->blend, next->blend)));
  }
  return {result};
}

Values unionOf(Call& call) { return combinedAll(call, Csg::Union); }
Values differenceOf(Call& call) { return combinedAll(call, Csg::Difference); }
Values intersectionOf(Call& call) { return combinedAll(call, Csg::Intersection); }

// Changes of one shape.

Values changed(Call& call, const Change& change) { return {call.engine().changed(call.shape(0), change)}; }

Values offsetOf(Call& call) {
  call.atMost(2);
  const double distance = call.reader().length("the distance", call[1], kAnyNumber);
  const auto apply = [distance](const DenseLevelSet& shape) { return offset(shape, distance); };
  return changed(call, {.needsDistance = true, .growth = std::max(0., distance), .apply = apply});
}

Values openingOf(Call& call) {
  call.atMost(2);
  const double radius = call.reader().length("the radius", call[1], kPositive);
  const auto apply = [radius](const DenseLevelSet& shape) { return opening(shape, radius); };
  return changed(call, {.needsDistance = true, .apply = apply});
}

Values closingOf(Call& call) {
  call.atMost(2);
  const double radius = call.reader().length("the radius", call[1], kPositive);
  const auto apply = [radius](const DenseLevelSet& shape) { return closing(shape, radius); };
  return changed(call, {.needsDistance = true, .apply = apply});
}

Preserve preserveOf(Call& call, const Fields& fields) {
  static const std::map<std::string, Preserve> kinds{{"none", Preserve::Nothing},
                                                     {"volume", Preserve::Volume},
                                                     {"topology", Preserve::Topology},
                                                     {"both", Preserve::Both}};
  if (!fields.has("preserve")) return Preserve::Both;
  const std::string text = call.reader().text("preserve", fields["preserve"]);
  const auto found = kinds.find(text);
  if (found == kinds.end())
    call.reader().refuse("preserve is " + quoted(text, '"') +
                         "; allowed: \"none\", \"volume\", \"topology\", \"both\"");
  return found->second;
}

/// What a smoothing was to keep and has not; empty for nothing.
std::string lossOf(const SmoothReport& report, Preserve preserve) {
  constexpr double kVolumeTolerance = 1.5e-3;  // smooth aims at 1e-3
  const double change = report.volumeAfter / report.volumeBefore - 1;
  std::string loss;
  if ((preserve == Preserve::Volume || preserve == Preserve::Both) && std::abs(change) > kVolumeTolerance) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%+.1f", 100 * change);
    loss = "the volume (" + std::string(text.data()) + " %)";
  }
  if ((preserve == Preserve::Topology || preserve == Preserve::Both) && !(report.before == report.after))
    loss += (loss.empty() ? "" : " and ") + std::string("the number of pieces or cavities");
  return loss;
}

Values smoothOf(Call& call) {
  const Fields fields = call.fields(1, {"time", "sigma", "preserve"});
  if (!fields.has("time") && !fields.has("sigma"))
    call.reader().refuse("time or sigma is missing; usage: " + call.reader().usage());
  SmoothOptions options;
  if (fields.has("time")) options.time = call.reader().number("time, in mm^2,", fields["time"], kNotNegative);
  options.sigma = fields.length("sigma", kNotNegative, 0);
  options.preserve = preserveOf(call, fields);
  const auto apply = [options, &session = call.session, line = call.line](const DenseLevelSet& shape) {
    DenseLevelSet result = shape;
    const std::string loss = lossOf(smooth(result, options), options.preserve);
    if (!loss.empty()) session.tell("line " + std::to_string(line) + ": smooth could not keep " + loss);
    return result;
  };
  return changed(call, {.needsDistance = true, .apply = apply});
}

Values keepLargestOf(Call& call) {
  call.atMost(2);
  const int count = call.has(1) ? call.reader().count("the number of pieces", call[1], 1) : 1;
  const auto apply = [count](const DenseLevelSet& shape) { return keepLargest(shape, count); };
  return changed(call, {.apply = apply});
}

Values dropSmallOf(Call& call) {
  call.atMost(2);
  const double least = call.reader().volume("the smallest volume", call[1], kNotNegative);
  const auto apply = [least](const DenseLevelSet& shape) { return dropSmall(shape, least); };
  return changed(call, {.apply = apply});
}

Values fillCavitiesOf(Call& call) {
  call.atMost(2);
  const double most = call.has(1) ? call.reader().volume("the largest volume", call[1], kPositive)
                                  : std::numeric_limits<double>::infinity();
  const auto apply = [most](const DenseLevelSet& shape) { return fillCavities(shape, most); };
  return changed(call, {.apply = apply});
}

Values fillHolesOf(Call& call) {
  call.atMost(2);
  const double width = call.reader().length("the width", call[1], kPositive);
  const auto apply = [width](const DenseLevelSet& shape) { return fillHoles(shape, width); };
  return changed(call, {.needsDistance = true, .apply = apply});
}

// Motions.

Values moved(Call& call, const Eigen::Affine3d& motion) {
  return {call.engine().moved(call.shape(0), motion)};
}

/// What a turn or a scaling leaves in place: the middle of the shape's box, unless it is given.
Eigen::Vector3d centerOf(Call& call, const Fields& fields) {
  if (fields.has("center")) return fields.point("center");
  const Eigen::Vector3d middle = call.engine().bounds(call.shape(0)).center();
  if (!middle.allFinite()) call.reader().refuse("center is missing; the shape has no middle");
  return middle;
}

Eigen::Affine3d about(const Eigen::Vector3d& center, const Eigen::Affine3d& motion) {
  return Eigen::Translation3d(center) * motion * Eigen::Translation3d(-center);
}

Values translateOf(Call& call) {
  call.atMost(2);
  return moved(call, Eigen::Affine3d(Eigen::Translation3d(call.reader().point("the shift", call[1]))));
}

Values rotateOf(Call& call) {
  const Fields fields = call.fields(1, {"axis", "degrees", "center"});
  const double angle = call.reader().number("degrees", fields["degrees"]) * std::numbers::pi / 180;
  const Eigen::Affine3d turn(Eigen::AngleAxisd(angle, fields.direction("axis").normalized()));
  return moved(call, about(centerOf(call, fields), turn));
}

Values scaleOf(Call& call) {
  const Fields fields = call.fields(1, {"factor", "center"});
  const double factor = call.reader().number("factor", fields["factor"], kPositive);
  return moved(call, about(centerOf(call, fields), Eigen::Affine3d(Eigen::UniformScaling<double>(factor))));
}

constexpr Binding kShapes[] = {
    {"__add", "a + b", As::Operator, add},
    {"__sub", "a - b", As::Operator, subtractPair},
    {"__mul", "a * b", As::Operator, multiply},
    {"union", "union(a, b, ..., {blend=mm})", As::Both, unionOf},
    {"difference", "difference(a, b, ..., {blend=mm})", As::Both, differenceOf},
    {"intersection", "intersection(a, b, ..., {blend=mm})", As::Both, intersectionOf},
    {"offset", "shape:offset(mm)", As::Both, offsetOf},
    {"opening", "shape:opening(mm)", As::Both, openingOf},
    {"closing", "shape:closing(mm)", As::Both, closingOf},
    {"smooth", "shape:smooth{time=mm^2 or sigma=mm, preserve=\"none|volume|topology|both\"}", As::Both,
     smoothOf},
    {"keep_largest", "shape:keep_largest(count)", As::Both, keepLargestOf},
    {"drop_small", "shape:drop_small(mm^3)", As::Both, dropSmallOf},
    {"fill_cavities", "shape:fill_cavities(mm^3)", As::Both, fillCavitiesOf},
    {"fill_holes", "shape:fill_holes(mm)", As::Both, fillHolesOf},
    {"translate", "shape:translate{x, y, z}", As::Both, translateOf},
    {"rotate", "shape:rotate{axis={x, y, z}, degrees=angle, center={x, y, z}}", As::Both, rotateOf},
    {"scale", "shape:scale{factor=number, center={x, y, z}}", As::Both, scaleOf},
};

}  // namespace

std::span<const Binding> shapeBindings() { return kShapes; }

}  // namespace sinew::repair
