#include "PlyFile.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <random>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;

/// A pyramid over a square, with what a reader has to pass over.
const std::vector<Vector3d> kNodes{{0, 0, 0}, {1.5, 0, 0}, {1.5, 1.5, 0}, {0, 1.5, 0}, {0.75, 0.75, 1}};
const std::vector<std::vector<int>> kPolygons{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
const std::vector<Triangle> kTriangles{{0, 3, 2}, {0, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};

std::string header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\ncomment made by hand\nobj_info none\n"
         "element camera 1\nproperty float view\nproperty list uchar int8 notes\n"
         "element vertex 5\nproperty uchar red\nproperty float x\nproperty double y\nproperty float32 z\n"
         "element nothing 999999999999\n"
         "element face 5\nproperty list uchar int vertex_indices\nproperty short weight\n"
         "element edge 1\nproperty int vertex1\nproperty uint vertex2\nend_header\n";
}

/// Numbers as text, or as bytes.
class Writer {
 public:
  explicit Writer(const std::string& format) : format_(format), bytes_(header(format)) {}
  template <class Number>
  void put(Number number) {
    if (format_ == "ascii") {
      bytes_ += std::to_string(number) + (++words_ % 4 == 0 ? "\r\n" : " ");
      return;
    }
    auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    if ((format_ == "binary_big_endian") != (std::endian::native == std::endian::big))
      std::ranges::reverse(bytes);
    bytes_.append(bytes.data(), bytes.size());
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string format_, bytes_;
  int words_ = 0;
};

std::string pyramid(const std::string& format) {
  Writer out(format);
  out.put(1.0F);  // camera
  out.put<std::uint8_t>(2);
  out.put<std::int8_t>(-1);
  out.put<std::int8_t>(7);
  for (const Vector3d& node : kNodes) {
    out.put<std::uint8_t>(200);
    out.put(static_cast<float>(node.x()));
    out.put(node.y());
    out.put(static_cast<float>(node.z()));
  }
  for (const std::vector<int>& polygon : kPolygons) {
    out.put(static_cast<std::uint8_t>(polygon.size()));
    for (const int corner : polygon) out.put<std::int32_t>(corner);
    out.put<std::int16_t>(-3);
  }
  out.put<std::int32_t>(0);  // edge
  out.put<std::uint32_t>(4000000000U);
  return out.bytes();
}

const std::vector<std::string> kEncodings{"ascii", "binary_little_endian", "binary_big_endian"};

TEST(PlyFile, ReadsEveryEncodingAndPassesOverTheRest) {
  const test::TempFolder folder;
  for (const std::string& format : kEncodings) {
    SCOPED_TRACE(format);
    test::writeBytes(folder / "a.ply", pyramid(format));
    const TriangleMesh mesh = readPly(folder / "a.ply");
    EXPECT_EQ(mesh.nodes, kNodes);
    EXPECT_EQ(mesh.triangles, kTriangles);
    EXPECT_EQ(readTriangleMesh(folder / "a.ply").triangles, kTriangles);
  }
}

TEST(PlyFile, ShortPolygonsAndOldNamesAreRead) {
  const test::TempFolder folder;
  test::writeBytes(folder / "a.ply",
                   "ply\r\nformat ascii 1.0\r\nelement face 4\r\nproperty list int32 uint32 vertex_index\r\n"
                   "element vertex 3\r\nproperty int x\r\nproperty int y\r\nproperty int z\r\nend_header\r\n"
                   "3 0 1 2 0 2 0 1 1 2\r\n0 0 0 +1 0 0 0 1e0 0");
  EXPECT_EQ(readPly(folder / "a.ply").triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(PlyFile, DamageIsNamedInOneLine) {
  const test::TempFolder folder;
  const auto file = folder / "a.ply";
  const auto message = [&](const std::string& bytes) {
    test::writeBytes(file, bytes);
    return test::messageOf<std::runtime_error>([&] { readPly(file); });
  };
  const auto edited = [](std::string bytes, const std::string& what, const std::string& with) {
    return bytes.replace(bytes.find(what), what.size(), with);
  };
  const std::string whole = pyramid("ascii");
  const std::string begin = file.string() + ": damaged or not a .ply file (";
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "its header does not end"},
      {"plyx\n", "it does not begin with \"ply\""},
      {"ply\nend_header\n", "its header names no format"},
      {whole.substr(0, 100), "its header does not end"},
      {edited(whole, "ascii 1.0", "ascii 2.0"), "line 2 of its header is not understood"},
      {edited(whole, "format ascii 1.0", "format text 1.0"), "line 2 of its header is not understood"},
      {edited(whole, "element vertex 5", "element vertex -5"), "line 8 of its header is not understood"},
      {edited(whole, "element vertex 5", "element vertex 99999999999999999999999"),
       "line 8 of its header is not understood"},
      {edited(whole, "property float x", "property half x"), "line 10 of its header is not understood"},
      {edited(whole, "property float x", "property float"), "line 10 of its header is not understood"},
      {edited(whole, "property float x", "propertyfloat x"), "line 10 of its header is not understood"},
      {edited(whole, "property float x", "property float u"), "its vertex element has no x"},
      {edited(whole, "double y", "list int double y"), "its vertex element has no y"},
      {edited(whole, "vertex_indices", "corners"), "its face element has no vertex_indices"},
      {edited(whole, "list uchar int vertex_indices", "int vertex_indices"),
       "its face element has no vertex_indices"},
      {edited(whole, "element vertex 5", "element vertex 999999999999"), "ends too early"},
      {edited(whole, "element face 5", "element face 999999999999"), "ends too early"},
      {whole.substr(0, whole.size() - 30), "ends too early"},
      {edited(whole, "1.500000", "nan"), "node 1 has no finite coordinates"},
      {edited(whole, "1.500000", "1e999"), "a word where a number is due"},
      {edited(whole, "1.500000", "1.5mm"), "a word where a number is due"}};
  for (const auto& [bytes, what] : cases) EXPECT_EQ(message(bytes).find(begin + what), 0u) << message(bytes);

  const std::string face =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty int x\nproperty int y\nproperty int z\n"
      "element face 1\nproperty list int float vertex_index\nend_header\n"
      "0 0 0 1 0 0 0 1 0\n";
  for (const std::string corners : {"3 0 1 3", "3 0 1 -1", "3 0 1 1.5", "3 0 1 nan", "3 0 1 4294967296"})
    EXPECT_EQ(message(face + corners), begin + "polygon 0 names a node that is not there)");
  EXPECT_EQ(message(face + "-3 0 1 2"), begin + "a list of -3.000000 numbers)");
  EXPECT_EQ(message(face + "4000000000 0 1 2"), begin + "ends too early)");
}

TEST(PlyFile, EveryCutAndEveryFlippedByteEndsInAMeshOrIsRefused) {
  std::mt19937 random(11);
  int refused = 0;
  const auto tryBytes = [&](const std::string& bytes) {
    try {
      const TriangleMesh mesh = parsePly(bytes);
      for (const Triangle& triangle : mesh.triangles)
        for (const std::int32_t node : triangle)
          ASSERT_TRUE(node >= 0 && static_cast<std::size_t>(node) < mesh.nodes.size());
    } catch (const PlyDamaged&) {
      ++refused;
    }
  };
  for (const std::string& format : kEncodings) {
    const std::string whole = pyramid(format);
    for (std::size_t size = 0; size < whole.size(); ++size) tryBytes(whole.substr(0, size));
    EXPECT_GT(refused, 400);
    for (int n = 0; n < 5000; ++n) {
      std::string bytes = whole;
      bytes[random() % bytes.size()] = static_cast<char>(random());
      tryBytes(bytes);
    }
  }
}

}  // namespace
}  // namespace sinew
