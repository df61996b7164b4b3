#include "ArgumentReader.h"

#include "sinew/Segmentation/NearestNames.h"

#include <charconv>
#include <cmath>
#include <optional>

namespace sinew::repair {
namespace {

constexpr const char* kPointForm = "three numbers {x, y, z} in mm";

std::string allowed(const Range& range) {
  std::string text;
  if (std::isfinite(range.least))
    text += (range.open ? " above " : " from ") + toText(range.least) + (range.open ? "" : " on");
  if (std::isfinite(range.most)) text += (text.empty() ? " up to " : ", up to ") + toText(range.most);
  return text;
}

bool holds(const Range& range, double number) {
  return std::isfinite(number) && number <= range.most &&
         (range.open ? number > range.least : number >= range.least);
}

struct Quantity {
  double number = 0;
  std::string unit;
};

std::optional<Quantity> parsedQuantity(const std::string& text) {
  Quantity quantity;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), quantity.number);
  if (error != std::errc()) return std::nullopt;
  quantity.unit.assign(end, text.data() + text.size());
  quantity.unit.erase(0, quantity.unit.find_first_not_of(' '));
  return quantity;
}

}  // namespace

Eigen::Vector3d flipped(const Eigen::Vector3d& v) { return {-v.x(), -v.y(), v.z()}; }

void ArgumentReader::refuse(const std::string& what) const { throw ScriptError(function_ + ": " + what); }

void ArgumentReader::refuse(const std::string& what, const Value& value, const std::string& allowed) const {
  if (std::holds_alternative<std::monostate>(value)) refuse(what + " is missing; usage: " + usage_);
  refuse(what + " is " + describe(value) + "; allowed: " + allowed);
}

void ArgumentReader::check(const std::string& what, const Value& value, double number, const Range& range,
                           const std::string& noun) const {
  if (!holds(range, number)) refuse(what, value, noun + allowed(range));
}

double ArgumentReader::number(const std::string& what, const Value& value, const Range& range) const {
  const double* number = std::get_if<double>(&value);
  if (number == nullptr) refuse(what, value, "a number" + allowed(range));
  check(what, value, *number, range, "a number");
  return *number;
}

int ArgumentReader::count(const std::string& what, const Value& value, int least) const {
  const Range range{static_cast<double>(least), false, 1e9};
  const double* number = std::get_if<double>(&value);
  if (number == nullptr || *number != std::floor(*number))
    refuse(what, value, "a whole number" + allowed(range));
  check(what, value, *number, range, "a whole number");
  return static_cast<int>(*number);
}

double ArgumentReader::quantity(const std::string& what, const Value& value, const Range& range,
                                const char* noun, const char* unit, double voxel) const {
  const std::string form = "a " + std::string(noun) + allowed(range) + ", in " + unit +
                           (std::string(noun) == "length" ? ", or a text like \"1.5mm\" or \"2vox\""
                                                          : ", or a text like \"20mm3\" or \"50vox\"");
  const double most = std::string(noun) == "length" ? kFarthest : std::pow(kFarthest, 3);
  double size = 0;
  if (const double* number = std::get_if<double>(&value)) {
    size = *number;
  } else if (const std::string* text = std::get_if<std::string>(&value)) {
    const std::optional<Quantity> parsed = parsedQuantity(*text);
    const bool known = parsed && (parsed->unit == "vox" || parsed->unit == unit ||
                                  (parsed->unit == "mm3" && std::string(unit) == "mm^3"));
    if (!known) refuse(what, value, form);
    size = parsed->unit == "vox" ? parsed->number * voxel : parsed->number;
  } else {
    refuse(what, value, form);
  }
  if (!holds(range, size)) refuse(what, value, form);
  if (std::abs(size) > most) refuse(what + " is " + describe(value) + ", which is no size of a body");
  return size;
}

double ArgumentReader::length(const std::string& what, const Value& value, const Range& range) const {
  return quantity(what, value, range, "length", "mm", units_.voxel);
}

double ArgumentReader::volume(const std::string& what, const Value& value, const Range& range) const {
  return quantity(what, value, range, "volume", "mm^3", units_.voxelVolume);
}

std::string ArgumentReader::text(const std::string& what, const Value& value) const {
  const std::string* text = std::get_if<std::string>(&value);
  if (text == nullptr) refuse(what, value, "a text");
  return *text;
}

const ShapePtr& ArgumentReader::shape(const std::string& what, const Value& value) const {
  const ShapePtr* shape = std::get_if<ShapePtr>(&value);
  if (shape == nullptr) refuse(what, value, "a shape, like tissue \"biceps\" or sphere{...}");
  return *shape;
}

const Table& ArgumentReader::table(const std::string& what, const Value& value) const {
  const TablePtr* table = std::get_if<TablePtr>(&value);
  if (table == nullptr) refuse(what, value, "a table in braces; usage: " + usage_);
  return **table;
}

Eigen::Vector3d ArgumentReader::point(const std::string& what, const Value& value) const {
  const TablePtr* table = std::get_if<TablePtr>(&value);
  if (table == nullptr || (*table)->items.size() != 3 || !(*table)->fields.empty())
    refuse(what, value, kPointForm);
  Eigen::Vector3d point;
  for (int axis = 0; axis < 3; ++axis)
    point[axis] = number("number " + std::to_string(axis + 1) + " of " + what, (*table)->items[axis],
                         {-kFarthest, false, kFarthest});
  return units_.ras ? flipped(point) : point;
}

Eigen::Vector3d ArgumentReader::direction(const std::string& what, const Value& value) const {
  const Eigen::Vector3d direction = point(what, value);
  if (!(direction.norm() > 0) || !std::isfinite(direction.norm()))
    refuse(what + " is {0, 0, 0}, no direction");
  return direction;
}

std::vector<Eigen::Vector3d> ArgumentReader::points(const std::string& what, const Value& value,
                                                    std::size_t least) const {
  const Table& list = table(what, value);
  if (!list.fields.empty() || list.items.size() < least)
    refuse(what, value, "a list of at least " + std::to_string(least) + " points {{x, y, z}, ...}");
  std::vector<Eigen::Vector3d> points;
  for (std::size_t n = 0; n < list.items.size(); ++n)
    points.push_back(point("point " + std::to_string(n + 1) + " of " + what, list.items[n]));
  return points;
}

Fields::Fields(const ArgumentReader& reader, const Value& value, std::initializer_list<const char*> known)
    : reader_(reader), fields_(reader.table("the argument", value).fields) {
  if (!reader.table("the argument", value).items.empty())
    reader.refuse("its arguments have names; usage: " + reader.usage());
  const std::vector<std::string> names(known.begin(), known.end());
  for (const auto& [name, field] : fields_)
    if (std::find(names.begin(), names.end(), name) == names.end())
      reader.refuse("unknown argument " + quoted(name) + "; the nearest is " + nearestNames(name, names, 1) +
                    "; usage: " + reader.usage());
}

const Value& Fields::operator[](const std::string& name) const {
  const auto found = fields_.find(name);
  if (found == fields_.end()) reader_.refuse(name + " is missing; usage: " + reader_.usage());
  return found->second;
}

}  // namespace sinew::repair
