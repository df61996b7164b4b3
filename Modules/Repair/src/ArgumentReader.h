#pragma once

#include "Binding.h"

#include <Eigen/Geometry>

#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace sinew::repair {

/// How numbers of a script become millimetres in LPS.
struct Units {
  double voxel = 1;        ///< what `1vox` stands for as a length, mm
  double voxelVolume = 1;  ///< and as a volume, mm^3
  bool ras = false;        ///< coordinates of the script are RAS
};

/// RAS to LPS, and back.
Eigen::Vector3d flipped(const Eigen::Vector3d& v);

/// No place or length in a script is farther than this, mm: a slip, or numbers beyond what samples can count.
inline constexpr double kFarthest = 1e6;

/// Numbers that an argument may have.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  bool open = false;  ///< without `least` itself
  double most = std::numeric_limits<double>::infinity();
};
inline constexpr Range kAnyNumber{}, kPositive{0, true}, kNotNegative{0, false};

/// Turns the arguments of one call into what the functions below it take, and says what is wrong with them:
/// `sphere: radius is the text "6cm"; allowed: a length above 0, in mm, or a text like "2vox"`.
/// Every function throws ScriptError.
class ArgumentReader {
 public:
  ArgumentReader(std::string function, std::string usage, const Units& units)
      : function_(std::move(function)), usage_(std::move(usage)), units_(units) {}

  [[noreturn]] void refuse(const std::string& what) const;
  [[noreturn]] void refuse(const std::string& what, const Value& value, const std::string& allowed) const;

  double number(const std::string& what, const Value& value, const Range& range = kAnyNumber) const;
  int count(const std::string& what, const Value& value, int least) const;
  /// mm, or a text with the unit mm or vox
  double length(const std::string& what, const Value& value, const Range& range) const;
  /// mm^3, or a text with the unit mm3 or vox
  double volume(const std::string& what, const Value& value, const Range& range) const;
  std::string text(const std::string& what, const Value& value) const;
  const ShapePtr& shape(const std::string& what, const Value& value) const;
  const Table& table(const std::string& what, const Value& value) const;
  /// A place or a shift: {x, y, z} in mm, to LPS
  Eigen::Vector3d point(const std::string& what, const Value& value) const;
  /// The same, not zero
  Eigen::Vector3d direction(const std::string& what, const Value& value) const;
  std::vector<Eigen::Vector3d> points(const std::string& what, const Value& value, std::size_t least) const;

  const std::string& usage() const { return usage_; }

 private:
  double quantity(const std::string& what, const Value& value, const Range& range, const char* noun,
                  const char* unit, double voxel) const;
  void check(const std::string& what, const Value& value, double number, const Range& range,
             const std::string& noun) const;

  std::string function_, usage_;
  Units units_;
};

/// The named arguments of one call: `sphere{center=..., radius=...}`.
class Fields {
 public:
  /// @throws ScriptError when there is a name that is not known, or an argument without a name
  Fields(const ArgumentReader& reader, const Value& table, std::initializer_list<const char*> known);

  bool has(const std::string& name) const { return fields_.contains(name); }
  /// @throws ScriptError when it is missing
  const Value& operator[](const std::string& name) const;

  Eigen::Vector3d point(const std::string& name) const { return reader_.point(name, (*this)[name]); }
  Eigen::Vector3d direction(const std::string& name) const { return reader_.direction(name, (*this)[name]); }
  double length(const std::string& name, const Range& range = kPositive) const {
    return reader_.length(name, (*this)[name], range);
  }
  double length(const std::string& name, const Range& range, double otherwise) const {
    return has(name) ? length(name, range) : otherwise;
  }

 private:
  const ArgumentReader& reader_;
  const std::map<std::string, Value>& fields_;
};

}  // namespace sinew::repair
