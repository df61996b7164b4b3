#include "ObjFile.h"

#include "FileFailure.h"
#include "Words.h"

#include <cmath>

namespace sinew {
namespace {

/// The next line, and those that a backslash at its end joins to it. @return false at the end
bool nextLine(std::istream& stream, std::string& line, std::size_t& number) {
  line.clear();
  std::string part;
  while (std::getline(stream, part)) {
    ++number;
    if (part.ends_with('\r')) part.pop_back();
    line += part;
    if (!line.ends_with('\\')) return true;
    line.back() = ' ';
  }
  return !line.empty();
}

/// `x y z`; what may follow, a weight or a colour, is passed over.
std::optional<Eigen::Vector3d> parseVertex(Words& words) {
  Eigen::Vector3d x;
  for (int axis = 0; axis < 3; ++axis) x[axis] = numberOf<double>(words.next()).value_or(std::nan(""));
  if (!x.allFinite()) return std::nullopt;
  return x;
}

/// `vertex`, `vertex/texture` or `vertex/texture/normal`: the node. Vertices count from 1, and from the last
/// one back from -1.
std::optional<std::int32_t> parseCorner(std::string_view word, std::size_t nodes) {
  const auto index = numberOf<std::int64_t>(word.substr(0, word.find('/')));
  const auto count = static_cast<std::int64_t>(nodes);
  if (!index || *index == 0 || *index > count || *index < -count) return std::nullopt;
  return static_cast<std::int32_t>(*index > 0 ? *index - 1 : count + *index);
}

/// Adds the fan of a polygon. @return false when it names a node that is not there
bool addPolygon(Words& words, TriangleMesh& mesh) {
  std::vector<std::int32_t> corners;
  for (auto word = words.next(); !word.empty(); word = words.next()) {
    const auto corner = parseCorner(word, mesh.nodes.size());
    if (!corner) return false;
    corners.push_back(*corner);
  }
  for (std::size_t k = 2; k < corners.size(); ++k)
    mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
  return true;
}

}  // namespace

TriangleMesh readObj(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  TriangleMesh mesh;
  std::string line;
  for (std::size_t number = 0; nextLine(stream, line, number);) {
    const auto damaged = [&](const char* what) {
      fail(file, "line " + std::to_string(number) + ": " + what);
    };
    Words words(line);
    const std::string_view keyword = words.next();
    if (keyword == "v") {
      const auto vertex = parseVertex(words);
      if (!vertex) damaged("a vertex needs three finite numbers");
      mesh.nodes.push_back(*vertex);
    } else if (keyword == "f" && !addPolygon(words, mesh)) {
      damaged("a polygon names a node that is not there");
    }
  }
  return mesh;
}

}  // namespace sinew
