#include "ClassicNetcdf.h"

#include <limits>
#include <numeric>
#include <stdexcept>

namespace sinew {
namespace {

enum Tag : std::int32_t { kDimension = 10, kVariable = 11, kAttribute = 12 };

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 3) / 4 * 4; }

/// The size of a list's tag and count, or of a name with its count.
constexpr std::uint64_t kListBytes = 8;
std::uint64_t nameBytes(const std::string& name) { return 4 + padded(name.size()); }

void putText(NetcdfValues& file, const std::string& text) {
  file.put(static_cast<std::int32_t>(text.size()));
  file.put(text, padded(text.size()));
}

void putList(NetcdfValues& file, Tag tag, std::size_t count) {
  file.put(count == 0 ? 0 : std::int32_t{tag});
  file.put(static_cast<std::int32_t>(count));
}

template <class Attributes>
std::uint64_t attributesBytes(const Attributes& attributes) {
  return std::accumulate(
      attributes.begin(), attributes.end(), kListBytes, [](std::uint64_t sum, const auto& a) {
        return sum + nameBytes(a.name) + 8 + (a.type == NetcdfType::Char ? padded(a.text.size()) : 4);
      });
}

template <class Attributes>
void putAttributes(NetcdfValues& file, const Attributes& attributes) {
  putList(file, kAttribute, attributes.size());
  for (const auto& attribute : attributes) {
    putText(file, attribute.name);
    file.put(static_cast<std::int32_t>(attribute.type));
    if (attribute.type == NetcdfType::Char) {
      putText(file, attribute.text);
    } else {
      file.put(1);
      file.put(std::bit_cast<std::int32_t>(attribute.number));
    }
  }
}

}  // namespace

int ClassicNetcdf::addDimension(std::string name, std::size_t size) {
  dimensions_.push_back({std::move(name), size});
  return static_cast<int>(dimensions_.size()) - 1;
}

void ClassicNetcdf::addAttribute(std::string name, std::string text) {
  attributes_.push_back({std::move(name), NetcdfType::Char, std::move(text), 0});
}
void ClassicNetcdf::addAttribute(std::string name, std::int32_t value) {
  attributes_.push_back({std::move(name), NetcdfType::Int, "", std::bit_cast<std::uint32_t>(value)});
}
void ClassicNetcdf::addAttribute(std::string name, float value) {
  attributes_.push_back({std::move(name), NetcdfType::Float, "", std::bit_cast<std::uint32_t>(value)});
}

void ClassicNetcdf::addVariable(std::string name, std::vector<int> dimensions, NetcdfType type,
                                std::function<void(NetcdfValues&)> values,
                                std::pair<std::string, std::string> attribute) {
  Variable variable{std::move(name), std::move(dimensions), type, std::move(values), {}};
  if (!attribute.first.empty())
    variable.attributes.push_back(
        {std::move(attribute.first), NetcdfType::Char, std::move(attribute.second), 0});
  variables_.push_back(std::move(variable));
}

std::uint64_t ClassicNetcdf::bytesOf(const Variable& variable) const {
  std::uint64_t bytes = variable.type == NetcdfType::Char ? 1 : variable.type == NetcdfType::Double ? 8 : 4;
  for (const int dimension : variable.dimensions)
    if (dimensions_[dimension].size != kGrows) bytes *= dimensions_[dimension].size;
  return padded(bytes);
}

std::uint64_t ClassicNetcdf::headerBytes() const {
  std::uint64_t bytes = 4 + 4 + 2 * kListBytes + attributesBytes(attributes_);
  for (const Dimension& dimension : dimensions_) bytes += nameBytes(dimension.name) + 4;
  for (const Variable& variable : variables_)
    bytes += nameBytes(variable.name) + 4 + 4 * variable.dimensions.size() +
             attributesBytes(variable.attributes) + 4 + 4 + 8;
  return bytes;
}

void ClassicNetcdf::write(const std::filesystem::path& path) const {
  TextWriter text(path);
  NetcdfValues file(text);
  text << std::string_view("CDF\2");
  file.put(0);  // records
  putList(file, kDimension, dimensions_.size());
  for (const Dimension& dimension : dimensions_) {
    putText(file, dimension.name);
    file.put(static_cast<std::int32_t>(dimension.size));
  }
  putAttributes(file, attributes_);
  putList(file, kVariable, variables_.size());
  const auto grows = [&](const Variable& variable) {
    return !variable.dimensions.empty() && dimensions_[variable.dimensions.front()].size == kGrows;
  };
  std::uint64_t begin = headerBytes(), records = begin;  // records stand behind all else
  for (const Variable& variable : variables_)
    if (!grows(variable)) records += bytesOf(variable);
  for (const Variable& variable : variables_) {
    const std::uint64_t bytes = bytesOf(variable);
    if (bytes > std::numeric_limits<std::uint32_t>::max() - 3)
      throw std::runtime_error(variable.name + " takes 4 GiB or more, for which the format has no room");
    putText(file, variable.name);
    file.put(static_cast<std::int32_t>(variable.dimensions.size()));
    for (const int dimension : variable.dimensions) file.put(std::int32_t{dimension});
    putAttributes(file, variable.attributes);
    file.put(static_cast<std::int32_t>(variable.type));
    file.put(std::bit_cast<std::int32_t>(static_cast<std::uint32_t>(bytes)));
    file.put(grows(variable) ? records : begin);
    if (!grows(variable)) begin += bytes;
  }
  for (const Variable& variable : variables_)
    if (!grows(variable)) variable.values(file);
  text.finish();
}

}  // namespace sinew
