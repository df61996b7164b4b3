#include "Bindings.h"

#include <algorithm>
#include <filesystem>

namespace sinew::repair {
namespace {

using Eigen::Vector3d;

Values made(Call& call, const Fields& fields, Solid solid) {
  return {call.engine().solid(std::move(solid), fields.length("blend", kNotNegative, 0))};
}

Values sphereOf(Call& call) {
  const Fields fields = call.fields(0, {"center", "radius", "blend"});
  return made(call, fields, sphere(fields.point("center"), fields.length("radius")));
}

Values ellipsoidOf(Call& call) {
  const Fields fields = call.fields(0, {"center", "radii", "blend"});
  const Table& radii = call.reader().table("radii", fields["radii"]);
  if (radii.items.size() != 3) call.reader().refuse("radii has to be three lengths {x, y, z}");
  Vector3d lengths;
  for (int axis = 0; axis < 3; ++axis)
    lengths[axis] = call.reader().length("number " + std::to_string(axis + 1) + " of radii",
                                         radii.items[axis], kPositive);
  return made(call, fields, ellipsoid(fields.point("center"), lengths));
}

Values boxOf(Call& call) {
  const Fields fields = call.fields(0, {"min", "max", "rounding", "blend"});
  const Vector3d a = fields.point("min"), b = fields.point("max");
  const Vector3d size = call.session.units().ras ? flipped(b - a) : Vector3d(b - a);
  for (int axis = 0; axis < 3; ++axis)
    if (!(size[axis] > 0))
      call.reader().refuse(std::string("max has to lie above min along ") + "xyz"[axis] + ", not " +
                           toText(-size[axis]) + " mm below");
  const double rounding = fields.length("rounding", {0, false, size.minCoeff() / 2}, 0);
  return made(call, fields, box(a.cwiseMin(b), a.cwiseMax(b), rounding));
}

/// The two ends of a solid along an axis.
std::pair<Vector3d, Vector3d> ends(Call& call, const Fields& fields) {
  const Vector3d from = fields.point("from"), to = fields.point("to");
  if (from == to) call.reader().refuse("from and to are the same point");
  return {from, to};
}

Values cylinderOf(Call& call) {
  const Fields fields = call.fields(0, {"from", "to", "radius", "blend"});
  const auto [from, to] = ends(call, fields);
  return made(call, fields, cylinder(from, to, fields.length("radius")));
}

Values capsuleOf(Call& call) {
  const Fields fields = call.fields(0, {"from", "to", "radius", "blend"});
  const auto [from, to] = ends(call, fields);
  return made(call, fields, capsule(from, to, fields.length("radius")));
}

Values coneOf(Call& call) {
  const Fields fields = call.fields(0, {"from", "to", "radius", "end_radius", "blend"});
  const auto [from, to] = ends(call, fields);
  const double radius = fields.length("radius", kNotNegative);
  const double endRadius = fields.length("end_radius", kNotNegative, 0);
  if (radius == 0 && endRadius == 0) call.reader().refuse("radius and end_radius are both 0");
  return made(call, fields, cone(from, to, radius, endRadius));
}

Values torusOf(Call& call) {
  const Fields fields = call.fields(0, {"center", "axis", "radius", "tube", "blend"});
  const double radius = fields.length("radius"), tube = fields.length("tube");
  if (!(tube < radius)) call.reader().refuse("tube is not below radius");
  return made(call, fields, torus(fields.point("center"), fields.direction("axis"), radius, tube));
}

Values halfSpaceOf(Call& call) {
  const Fields fields = call.fields(0, {"point", "normal", "blend"});
  return made(call, fields, halfSpace(fields.point("point"), fields.direction("normal")));
}

/// One length for all points, or one for each.
std::vector<double> tubeRadii(Call& call, const Value& value, std::size_t points) {
  const TablePtr* table = std::get_if<TablePtr>(&value);
  if (table == nullptr) return {call.reader().length("radius", value, kPositive)};
  if ((*table)->items.size() != points || !(*table)->fields.empty())
    call.reader().refuse("radius has to be one length, or a list of " + std::to_string(points) +
                         ", one for each point");
  std::vector<double> radii;
  for (const Value& item : (*table)->items)
    radii.push_back(call.reader().length("radius " + std::to_string(radii.size() + 1), item, kPositive));
  return radii;
}

Values tubeOf(Call& call) {
  const Fields fields = call.fields(0, {"points", "radius", "blend"});
  const std::vector<Vector3d> points = call.reader().points("points", fields["points"], 2);
  return made(call, fields, tube(points, tubeRadii(call, fields["radius"], points.size())));
}

Values hullOf(Call& call) {
  const Fields fields = call.fields(0, {"points", "blend"});
  return made(call, fields, convexHull(call.reader().points("points", fields["points"], 4)));
}

/// The only files that a script can name: surfaces beside it, or below.
std::filesystem::path meshFile(Call& call, const std::string& name) {
  const std::filesystem::path file = name;
  const std::string type = file.extension().string();
  constexpr std::array types{".stl", ".ply", ".obj", ".vtp"};
  if (std::find(types.begin(), types.end(), type) == types.end())
    call.reader().refuse("file is " + quoted(name, '"') + "; allowed: a surface, .stl, .ply, .obj or .vtp");
  if (file.is_absolute() || std::find(file.begin(), file.end(), "..") != file.end())
    call.reader().refuse("file is " + quoted(name, '"') +
                         "; allowed: a path from the script's folder downwards");
  return call.session.options().meshFolder / file;
}

Values meshOf(Call& call) {
  const Fields fields = call.fields(0, {"file"});
  const std::filesystem::path file = meshFile(call, call.reader().text("file", fields["file"]));
  const TriangleMesh surface = readTriangleMesh(file);
  try {
    return {call.engine().mesh(surface)};
  } catch (const ScriptError&) {
    throw;
  } catch (const std::invalid_argument& error) {
    throw ScriptError(file.string() + ": " + error.what());
  }
}

constexpr Binding kSolids[] = {
    {"sphere", "sphere{center={x, y, z}, radius=mm}", Binding::As::Function, sphereOf},
    {"ellipsoid", "ellipsoid{center={x, y, z}, radii={mm, mm, mm}}", Binding::As::Function, ellipsoidOf},
    {"box", "box{min={x, y, z}, max={x, y, z}, rounding=mm}", Binding::As::Function, boxOf},
    {"cylinder", "cylinder{from={x, y, z}, to={x, y, z}, radius=mm}", Binding::As::Function, cylinderOf},
    {"capsule", "capsule{from={x, y, z}, to={x, y, z}, radius=mm}", Binding::As::Function, capsuleOf},
    {"cone", "cone{from={x, y, z}, to={x, y, z}, radius=mm, end_radius=mm}", Binding::As::Function, coneOf},
    {"torus", "torus{center={x, y, z}, axis={x, y, z}, radius=mm, tube=mm}", Binding::As::Function, torusOf},
    {"halfspace", "halfspace{point={x, y, z}, normal={x, y, z}}", Binding::As::Function, halfSpaceOf},
    {"tube", "tube{points={{x, y, z}, ...}, radius=mm or {mm, ...}}", Binding::As::Function, tubeOf},
    {"hull", "hull{points={{x, y, z}, ...}}", Binding::As::Function, hullOf},
    {"mesh", "mesh{file=\"name.stl\"}", Binding::As::Function, meshOf},
};

}  // namespace

std::span<const Binding> solidBindings() { return kSolids; }

}  // namespace sinew::repair
