#include "StlFile.h"

#include "FileFailure.h"
#include "Words.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <iterator>
#include <sstream>

namespace sinew {
namespace {

static_assert(std::endian::native == std::endian::little, "as the numbers of the files");

/// A binary file: a comment, the number of facets, then each facet's normal, three corners and two free
/// bytes.
constexpr std::size_t kComment = 80, kFirstFacet = 84, kFacet = 50, kNormal = 12;

template <class Number>
Number take(std::string_view bytes, std::size_t offset) {
  Number value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::uint64_t facetsClaimed(std::string_view bytes) {
  return bytes.size() < kFirstFacet ? 0 : take<std::uint32_t>(bytes, kComment);
}

/// Some binary files begin with `solid`, too: their size tells.
bool isBinary(std::string_view bytes) {
  if (bytes.size() >= kFirstFacet && bytes.size() == kFirstFacet + kFacet * facetsClaimed(bytes)) return true;
  return Words(bytes.substr(0, kComment)).next() != "solid";
}

void addCorner(TriangleMesh& mesh, const Eigen::Vector3d& x, const std::filesystem::path& file) {
  const std::size_t facet = mesh.nodes.size() / 3;
  if (!x.allFinite()) fail(file, "facet " + std::to_string(facet) + " has no finite coordinates");
  mesh.nodes.push_back(x);
}

/// Every three nodes are a triangle.
void addTriangles(TriangleMesh& mesh) {
  const auto nodes = static_cast<std::int32_t>(mesh.nodes.size());
  for (std::int32_t n = 0; n < nodes; n += 3) mesh.triangles.push_back({n, n + 1, n + 2});
}

TriangleMesh readBinary(std::string_view bytes, const std::filesystem::path& file) {
  const std::uint64_t facets = facetsClaimed(bytes);
  if (bytes.size() < kFirstFacet + kFacet * facets)
    fail(file, "damaged or not an .stl file (it is too short for its " + std::to_string(facets) + " facets)");
  TriangleMesh mesh;
  for (std::uint64_t facet = 0; facet < facets; ++facet) {
    const std::size_t corners = kFirstFacet + kFacet * facet + kNormal;
    for (std::size_t corner = corners; corner < corners + 36; corner += 12)
      addCorner(mesh,
                {take<float>(bytes, corner), take<float>(bytes, corner + 4), take<float>(bytes, corner + 8)},
                file);
  }
  return mesh;
}

std::string lower(std::string_view word) {
  std::string result(word);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

/// Lines `vertex x y z`, three in each facet; of the other lines only the ends count.
TriangleMesh readAscii(const std::string& bytes, const std::filesystem::path& file) {
  std::istringstream stream(bytes);
  TriangleMesh mesh;
  bool ended = false;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line); ++number) {
    Words words(line);
    const std::string keyword = lower(words.next());
    if (keyword == "vertex") {
      Eigen::Vector3d x;
      for (int axis = 0; axis < 3; ++axis) x[axis] = numberOf<double>(words.next()).value_or(std::nan(""));
      addCorner(mesh, x, file);
    } else if (keyword == "endfacet" && mesh.nodes.size() % 3 != 0) {
      fail(file, "line " + std::to_string(number) + ": a facet has not three corners");
    }
    ended = keyword == "endsolid" || (ended && keyword.empty());
  }
  if (!ended || mesh.nodes.size() % 3 != 0) fail(file, "damaged or not an .stl file (it ends too early)");
  return mesh;
}

}  // namespace

TriangleMesh readStl(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  TriangleMesh mesh = isBinary(bytes) ? readBinary(bytes, file) : readAscii(bytes, file);
  addTriangles(mesh);
  return mesh;
}

}  // namespace sinew
