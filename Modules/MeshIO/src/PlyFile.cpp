#include "PlyFile.h"

#include "FileFailure.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <iterator>

namespace sinew {
namespace {

/// The numbers behind a header, one after the other. @throws PlyDamaged where they end
class Values {
 public:
  Values(std::string_view bytes, PlyEncoding encoding) : rest_(bytes), encoding_(encoding) {}

  double next(PlyKind kind) { return encoding_ == PlyEncoding::Ascii ? nextWord() : nextBinary(kind); }

  std::uint64_t nextCount(PlyKind kind) {
    const double count = next(kind);
    if (!(count >= 0) || count != std::floor(count) || count > 4294967295.0)
      throw PlyDamaged("a list of " + std::to_string(count) + " numbers");
    return static_cast<std::uint64_t>(count);
  }

 private:
  double nextWord() {
    const std::size_t first = rest_.find_first_not_of(" \t\r\n\v\f");
    if (first == std::string_view::npos) throw PlyDamaged("ends too early");
    rest_.remove_prefix(first);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\n\v\f"));
    rest_.remove_prefix(word.size());
    const char *begin = word.data() + (word.front() == '+' ? 1 : 0), *end = word.data() + word.size();
    double value = 0;
    const auto [stop, error] = std::from_chars(begin, end, value);
    if (stop != end || error != std::errc()) throw PlyDamaged("a word where a number is due");
    return value;
  }

  double nextBinary(PlyKind kind) {
    switch (kind) {
      case PlyKind::Int8:
        return take<std::int8_t>();
      case PlyKind::UInt8:
        return take<std::uint8_t>();
      case PlyKind::Int16:
        return take<std::int16_t>();
      case PlyKind::UInt16:
        return take<std::uint16_t>();
      case PlyKind::Int32:
        return take<std::int32_t>();
      case PlyKind::UInt32:
        return take<std::uint32_t>();
      case PlyKind::Float32:
        return take<float>();
      case PlyKind::Float64:
        return take<double>();
    }
    return 0;
  }

  template <class Number>
  Number take() {
    std::array<char, sizeof(Number)> bytes;
    if (rest_.size() < bytes.size()) throw PlyDamaged("ends too early");
    std::copy_n(rest_.begin(), bytes.size(), bytes.begin());
    rest_.remove_prefix(bytes.size());
    const bool swapped = (encoding_ == PlyEncoding::BigEndian) != (std::endian::native == std::endian::big);
    if (swapped) std::ranges::reverse(bytes);
    return std::bit_cast<Number>(bytes);
  }

  std::string_view rest_;
  PlyEncoding encoding_;
};

/// Passes the numbers of an element's rows on: visit(property, number), then endOfRow().
template <class Visit, class EndOfRow>
void readRows(const PlyElement& element, Values& values, const Visit& visit, const EndOfRow& endOfRow) {
  if (element.properties.empty()) return;  // rows without a number take no bytes
  for (std::uint64_t row = 0; row < element.rows; ++row) {
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      const std::uint64_t count = property.listCount ? values.nextCount(*property.listCount) : 1;
      for (std::uint64_t n = 0; n < count; ++n) visit(p, values.next(property.kind));
    }
    endOfRow();
  }
}

/// The place of the first property with one of these names; @throws where there is none of the right form
std::size_t propertyOf(const PlyElement& element, std::initializer_list<std::string_view> names, bool list) {
  for (std::size_t p = 0; p < element.properties.size(); ++p)
    if (std::ranges::find(names, element.properties[p].name) != names.end() &&
        element.properties[p].listCount.has_value() == list)
      return p;
  throw PlyDamaged("its " + element.name + " element has no " + std::string(*names.begin()));
}

std::vector<Eigen::Vector3d> readVertices(const PlyElement& element, Values& values) {
  const std::array<std::size_t, 3> axes{propertyOf(element, {"x"}, false), propertyOf(element, {"y"}, false),
                                        propertyOf(element, {"z"}, false)};
  std::vector<Eigen::Vector3d> nodes;
  Eigen::Vector3d node;
  readRows(
      element, values,
      [&](std::size_t property, double value) {
        for (int a = 0; a < 3; ++a)
          if (property == axes[static_cast<std::size_t>(a)]) node[a] = value;
      },
      [&] {
        if (!node.allFinite())
          throw PlyDamaged("node " + std::to_string(nodes.size()) + " has no finite coordinates");
        nodes.push_back(node);
      });
  return nodes;
}

/// Polygons as they come: their corners, and where each ends.
struct Polygons {
  std::vector<std::int32_t> corners;  ///< -1: no node
  std::vector<std::size_t> ends;
};

Polygons readPolygons(const PlyElement& element, Values& values) {
  const std::size_t corners = propertyOf(element, {"vertex_indices", "vertex_index"}, true);
  Polygons polygons;
  readRows(
      element, values,
      [&](std::size_t property, double value) {
        if (property != corners) return;
        const bool isIndex = value >= 0 && value <= 2147483647.0 && value == std::floor(value);
        polygons.corners.push_back(isIndex ? static_cast<std::int32_t>(value) : -1);
      },
      [&] { polygons.ends.push_back(polygons.corners.size()); });
  return polygons;
}

std::vector<Triangle> fansOf(const Polygons& polygons, std::size_t nodes) {
  std::vector<Triangle> triangles;
  std::size_t first = 0;
  for (std::size_t n = 0; n < polygons.ends.size(); ++n) {
    for (std::size_t k = first; k < polygons.ends[n]; ++k) {
      const std::int32_t corner = polygons.corners[k];
      if (corner < 0 || static_cast<std::size_t>(corner) >= nodes)
        throw PlyDamaged("polygon " + std::to_string(n) + " names a node that is not there");
      if (k >= first + 2) triangles.push_back({polygons.corners[first], polygons.corners[k - 1], corner});
    }
    first = polygons.ends[n];
  }
  return triangles;
}

}  // namespace

TriangleMesh parsePly(std::string_view bytes) {
  const PlyHeader header = parsePlyHeader(bytes);
  Values values(bytes.substr(header.size), header.encoding);
  TriangleMesh mesh;
  Polygons polygons;
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex")
      mesh.nodes = readVertices(element, values);
    else if (element.name == "face")
      polygons = readPolygons(element, values);
    else
      readRows(
          element, values, [](std::size_t, double) {}, [] {});
  }
  mesh.triangles = fansOf(polygons, mesh.nodes.size());
  return mesh;
}

TriangleMesh readPly(const std::filesystem::path& file) try {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return parsePly(bytes);
} catch (const PlyDamaged& damage) {
  fail(file, std::string("damaged or not a .ply file (") + damage.what() + ")");
}

}  // namespace sinew
