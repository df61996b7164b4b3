#include "CheckedCells.h"
#include "LegacyVtkFile.h"
#include "LegacyVtkScanner.h"
#include "MeshFormatTable.h"
#include "Words.h"

#include <array>
#include <charconv>
#include <iterator>
#include <optional>

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kTetType = 10;  // VTK_TETRA

/// Attributes of the form `KEYWORD name type`, with their components.
struct PlainAttribute {
  std::string_view keyword;
  std::int64_t components;
};
constexpr std::array<PlainAttribute, 7> kPlainAttributes{{{"vectors", 3},
                                                          {"normals", 3},
                                                          {"tensors", 9},
                                                          {"tensors6", 6},
                                                          {"global_ids", 1},
                                                          {"pedigree_ids", 1},
                                                          {"edge_flags", 1}}};

/// What an array is to be.
struct ArrayHead {
  std::string_view name;
  std::int64_t components;
  std::string type;  ///< lower case
};

class LegacyVtkReader {
 public:
  LegacyVtkReader(std::string_view bytes, const fs::path& file, const ReadMeshOptions& options)
      : scan_(bytes, file), file_(file), options_(options) {}

  TissueMesh read() {
    readHeader();
    for (std::string keyword = scan_.keyword(); !keyword.empty(); keyword = scan_.keyword())
      readSection(keyword);
    return finished();
  }

 private:
  void readHeader() {
    constexpr std::string_view kStart = "# vtk DataFile Version ";
    const std::string_view version = scan_.line();
    if (!version.starts_with(kStart)) scan_.damaged("it does not begin with \"# vtk DataFile Version\"");
    cellsByOffsets_ = version.substr(kStart.size()) >= "5";
    ras_ = scan_.line().find("SPACE=RAS") != std::string_view::npos;
    const std::string encoding = scan_.keyword();
    if (encoding != "ascii" && encoding != "binary") scan_.damaged("it is neither ASCII nor BINARY");
    scan_.binary = encoding == "binary";
    if (scan_.keyword() != "dataset" || scan_.keyword() != "unstructured_grid")
      fail(file_, "holds no unstructured grid");
  }

  void readSection(const std::string& keyword) {
    if (keyword == "points") {
      const std::int64_t points = scan_.count();
      coordinates_ = scan_.numbers(scan_.keyword(), times(3, points));
    } else if (keyword == "cells") {
      cellsByOffsets_ ? readCellsByOffsets() : readCells();
    } else if (keyword == "cell_types") {
      types_ = scan_.wholeNumbers("int", scan_.count());
    } else if (keyword == "cell_data" || keyword == "point_data") {
      ofCells_ = keyword == "cell_data";
      tuples_ = scan_.count();
    } else if (keyword == "field") {
      readField();
    } else if (keyword == "metadata") {
      scan_.line();
      while (!scan_.line().empty()) {
      }
    } else {
      readAttribute(keyword);
    }
  }

  /// Each cell its number of nodes, then the nodes.
  void readCells() {
    const std::int64_t cells = scan_.count(), size = scan_.count();
    const std::vector<std::int64_t> numbers = scan_.wholeNumbers("int", size);
    offsets_ = {0};
    connectivity_.clear();
    for (auto at = numbers.begin(); at != numbers.end();) {
      const std::int64_t nodes = *at++;
      if (nodes < 0 || nodes > numbers.end() - at) scan_.damaged("a cell has too many nodes");
      connectivity_.insert(connectivity_.end(), at, at + nodes);
      at += nodes;
      offsets_.push_back(std::ssize(connectivity_));
    }
    if (std::ssize(offsets_) != cells + 1) scan_.damaged("it has another number of cells than it says");
  }

  void readCellsByOffsets() {
    const std::int64_t offsets = scan_.count(), size = scan_.count();
    if (scan_.keyword() != "offsets") scan_.damaged("expected OFFSETS");
    offsets_ = scan_.wholeNumbers(scan_.keyword(), offsets);
    if (scan_.keyword() != "connectivity") scan_.damaged("expected CONNECTIVITY");
    connectivity_ = scan_.wholeNumbers(scan_.keyword(), size);
    const bool inOrder = std::ranges::is_sorted(offsets_);
    if (!inOrder || (offsets > 0 && (offsets_.front() < 0 || offsets_.back() > size)))
      scan_.damaged("the offsets of its cells are not in order");
  }

  void readField() {
    scan_.word();  // its name
    const std::int64_t arrays = scan_.count();
    for (std::int64_t a = 0; a < arrays; ++a) {
      const std::string_view name = scan_.word();
      if (name.empty()) scan_.damaged("a field has fewer arrays than it says");
      const std::int64_t components = scan_.count(), tuples = scan_.count();
      takeArray({name, components, scan_.keyword()}, tuples);
    }
  }

  void readAttribute(const std::string& keyword) {
    const auto* plain = std::ranges::find(kPlainAttributes, keyword, &PlainAttribute::keyword);
    if (plain != kPlainAttributes.end()) {
      const std::string_view name = scan_.word();
      takeArray({name, plain->components, scan_.keyword()}, tuples_);
    } else if (keyword == "scalars") {
      readScalars();
    } else if (keyword == "texture_coordinates") {
      const std::string_view name = scan_.word();
      const std::int64_t components = scan_.count();
      takeArray({name, components, scan_.keyword()}, tuples_);
    } else if (keyword == "color_scalars") {
      scan_.word();  // its name
      skipColors(scan_.count(), tuples_);
    } else if (keyword == "lookup_table") {
      scan_.word();  // its name
      skipColors(4, scan_.count());
    } else {
      scan_.damaged("unknown keyword " + printable(keyword));
    }
  }

  /// `SCALARS name type [components]`, and a line `LOOKUP_TABLE name`.
  void readScalars() {
    Words words(scan_.line());
    ArrayHead head{words.next(), 1, std::string(words.next())};
    if (const std::string_view components = words.next(); !components.empty()) {
      const auto number = numberOf<std::int64_t>(components);
      if (!number || *number < 1) scan_.damaged("scalars have no number of components");
      head.components = *number;
    }
    if (scan_.keyword() != "lookup_table") scan_.damaged("expected LOOKUP_TABLE");
    scan_.word();  // its name
    takeArray(head, tuples_);
  }

  void takeArray(const ArrayHead& head, std::int64_t tuples) {
    const std::int64_t count = times(head.components, tuples);
    if (ofCells_ && head.name == "labels" && head.components == 1)
      labels_ = scan_.numbers(head.type, count);
    else if (ofCells_ && head.name == "RGB" && head.components == 3 && head.type == "unsigned_char")
      colors_ = scan_.numbers(head.type, count);
    else if (options_.cellArrays && ofCells_ && (head.type == "float" || head.type == "double"))
      cellArrays_.push_back(readNumbers(head, count));
    else
      scan_.skip(head.type, count);
  }

  MeshArray readNumbers(const ArrayHead& head, std::int64_t count) {
    const std::vector<double> numbers = scan_.numbers(head.type, count);
    return {decoded(head.name), {numbers.begin(), numbers.end()}, static_cast<int>(head.components)};
  }

  /// Bytes, or as text fractions of 1.
  void skipColors(std::int64_t components, std::int64_t tuples) {
    scan_.skip("unsigned_char", times(components, tuples));
  }

  std::int64_t times(std::int64_t components, std::int64_t tuples) const {
    std::int64_t product = 0;
    if (__builtin_mul_overflow(components, tuples, &product)) scan_.damaged("an array is too large");
    return product;
  }

  /// Names have `%20` where a blank was.
  static std::string decoded(std::string_view name) {
    std::string text;
    for (std::size_t i = 0; i < name.size(); ++i) {
      unsigned code = 0;
      if (name[i] == '%' && i + 2 < name.size() &&
          std::from_chars(&name[i + 1], &name[i] + 3, code, 16).ptr == &name[i] + 3)
        i += 2;
      else
        code = static_cast<unsigned char>(name[i]);
      text += static_cast<char>(code);
    }
    return text;
  }

  static std::string printable(const std::string& word) {
    std::string text = word.substr(0, 40);
    std::ranges::replace_if(
        text, [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
    return text;
  }

  TissueMesh finished() {
    TissueMesh mesh;
    takeNodes(mesh.mesh);
    const auto cells = static_cast<std::size_t>(std::max<std::ptrdiff_t>(std::ssize(offsets_) - 1, 0));
    if (types_.size() != cells) scan_.damaged("it has another number of cells than of their types");
    if (!labels_.empty() && labels_.size() != cells)
      scan_.damaged("it has another number of labels than of cells");
    if (!colors_.empty() && colors_.size() != 3 * cells) colors_.clear();
    FirstCells firstCells;
    std::vector<std::size_t> tets;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      if (types_[cell] != kTetType) continue;
      const auto number = static_cast<std::int64_t>(cell);
      tets.push_back(cell);
      mesh.mesh.tets.push_back(checkedTet(connectivity_.data() + offsets_[cell],
                                          offsets_[cell + 1] - offsets_[cell], number, mesh.mesh.nodes.size(),
                                          file_));
      mesh.mesh.labels.push_back(labels_.empty() ? 1 : checkedLabel(labels_[cell], number, file_));
      firstCells.note(mesh.mesh.labels.back(), number);
    }
    mesh.arrays.cells = arraysOf(tets, cells);
    mesh.regions =
        firstCells.regions({}, [&](std::int64_t cell) { return colorOf(static_cast<std::size_t>(cell)); });
    return mesh;
  }

  /// The arrays that have a tuple for each cell, of tets alone.
  std::vector<MeshArray> arraysOf(const std::vector<std::size_t>& tets, std::size_t cells) const {
    std::vector<MeshArray> arrays;
    for (const MeshArray& array : cellArrays_) {
      const auto size = static_cast<std::size_t>(array.components);
      if (size == 0 || array.values.size() != cells * size) continue;
      MeshArray& part = arrays.emplace_back(MeshArray{array.name, {}, array.components});
      for (const std::size_t tet : tets)
        for (std::size_t c = 0; c < size; ++c) part.values.push_back(array.values[tet * size + c]);
      part.values = turned(part, space());
    }
    return arrays;
  }

  Space space() const { return ras_ ? Space::Ras : Space::Lps; }

  void takeNodes(TetMesh& mesh) {
    const WriteMeshOptions options{.space = space()};
    for (std::size_t n = 0; 3 * n < coordinates_.size(); ++n) {
      const Eigen::Vector3d x(&coordinates_[3 * n]);
      if (!x.allFinite()) fail(file_, "node " + std::to_string(n) + " has no finite coordinates");
      mesh.nodes.push_back(inFile(x, options));
    }
  }

  std::optional<std::array<double, 3>> colorOf(std::size_t cell) const {
    if (colors_.empty()) return std::nullopt;
    return std::array{colors_[3 * cell] / 255, colors_[3 * cell + 1] / 255, colors_[3 * cell + 2] / 255};
  }

  LegacyVtkScanner scan_;
  const fs::path& file_;
  ReadMeshOptions options_;
  std::vector<MeshArray> cellArrays_;
  bool cellsByOffsets_ = false, ras_ = false;
  bool ofCells_ = false;     ///< arrays that come are of cells
  std::int64_t tuples_ = 0;  ///< of arrays that come
  std::vector<double> coordinates_, labels_, colors_;
  std::vector<std::int64_t> offsets_, connectivity_, types_;
};

}  // namespace

TissueMesh readLegacyVtk(const fs::path& file, const ReadMeshOptions& options) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return LegacyVtkReader(bytes, file, options).read();
}

}  // namespace sinew
