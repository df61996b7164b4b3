#include "ExodusFile.h"

#include "ClassicNetcdf.h"
#include "CoordinatesNote.h"
#include "LegalNames.h"
#include "SolverMesh.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace sinew {
namespace {

constexpr std::string_view kBoundary = "_boundary";
constexpr std::size_t kNameWidth = 256;  // with a 0 at the end
constexpr NameRule kExodusNames{.maxBytes = kNameWidth - 1 - kBoundary.size(), .refused = ""};

/// The side of a tet by the corner opposite to it: side 1 has the corners 1 2 4, 2: 2 3 4, 3: 1 4 3, 4: 1
/// 3 2.
constexpr std::array<int, 4> kExodusSide{2, 3, 1, 4};

class ExodusWriter {
 public:
  ExodusWriter(const SolverMesh& mesh, const WriteMeshOptions& options)
      : mesh_(mesh),
        tags_(mesh.tags()),
        names_(legalNames(mesh.regions(), kExodusNames)),
        place_(mesh.tetCount()) {
    for (const std::string& name : names_) sideNames_.push_back(name + std::string(kBoundary));
    std::int32_t place = 0;
    for (const SolverPart& part : mesh.parts())
      for (const std::int32_t t : part.tets) place_[t] = ++place;
    addAttributes(coordinatesNote(options));
    nameWidth_ = file_.addDimension("len_name", kNameWidth);
    file_.addVariable("time_whole", {file_.addDimension("time_step", ClassicNetcdf::kGrows)},
                      NetcdfType::Double, {});
    addNodes();
    addBlocks();
    addSideSets();
  }

  void write(const std::filesystem::path& file) const { file_.write(file); }

 private:
  /// Those of the Exodus library that Debian 12 has, and that every one reads.
  void addAttributes(std::string title) {
    constexpr float kVersion = 8.11F;
    std::size_t longest = 0;
    for (const std::string& name : sideNames_) longest = std::max(longest, name.size());
    file_.addAttribute("api_version", kVersion);
    file_.addAttribute("version", kVersion);
    file_.addAttribute("floating_point_word_size", 8);
    file_.addAttribute("file_size", 1);
    file_.addAttribute("maximum_name_length", static_cast<std::int32_t>(longest));
    file_.addAttribute("int64_status", 0);
    file_.addAttribute("title", std::move(title));
  }

  void addNodes() {
    const int axes = file_.addDimension("num_dim", 3),
              nodes = file_.addDimension("num_nodes", mesh_.nodeCount());
    addNames("coor_names", axes, kAxes);
    for (int axis = 0; axis < 3; ++axis)
      file_.addVariable("coord" + kAxes[axis], {nodes}, NetcdfType::Double,
                        [this, axis](NetcdfValues& values) {
                          for (std::size_t n = 0; n < mesh_.nodeCount(); ++n) values.put(mesh_.node(n)[axis]);
                        });
  }

  void addBlocks() {
    const int elements = file_.addDimension("num_elem", mesh_.tetCount());
    const int blocks = file_.addDimension("num_el_blk", mesh_.parts().size());
    addEntities("eb", blocks);
    addNames("eb_names", blocks, names_);
    file_.addVariable("elem_num_map", {elements}, NetcdfType::Int, [this](NetcdfValues& values) {
      for (const SolverPart& part : mesh_.parts())
        for (const std::int32_t t : part.tets) values.put(t + 1);
    });
    for (std::size_t p = 0; p < mesh_.parts().size(); ++p) {
      const SolverPart& part = mesh_.parts()[p];
      const std::string number = std::to_string(p + 1);
      file_.addVariable("connect" + number,
                        {file_.addDimension("num_el_in_blk" + number, part.tets.size()),
                         file_.addDimension("num_nod_per_el" + number, mesh_.quadratic() ? 10 : 4)},
                        NetcdfType::Int,
                        [this, &part](NetcdfValues& values) {
                          for (const std::int32_t t : part.tets)
                            for (const std::int32_t node : mesh_.tet(static_cast<std::size_t>(t)))
                              values.put(node + 1);
                        },
                        {"elem_type", mesh_.quadratic() ? "TETRA10" : "TETRA4"});
    }
  }

  void addSideSets() {
    const int sets = file_.addDimension("num_side_sets", mesh_.parts().size());
    addEntities("ss", sets);
    addNames("ss_names", sets, sideNames_);
    for (std::size_t p = 0; p < mesh_.parts().size(); ++p) {
      const SolverPart& part = mesh_.parts()[p];
      const std::string number = std::to_string(p + 1);
      const int sides = file_.addDimension("num_side_ss" + number, part.boundary.size());
      file_.addVariable("elem_ss" + number, {sides}, NetcdfType::Int, [this, &part](NetcdfValues& values) {
        for (const TetFace& face : part.boundary) values.put(place_[face.tet]);
      });
      file_.addVariable("side_ss" + number, {sides}, NetcdfType::Int, [&part](NetcdfValues& values) {
        for (const TetFace& face : part.boundary) values.put(std::int32_t{kExodusSide[face.face]});
      });
    }
  }

  /// That every block or set is there, and its id.
  void addEntities(const std::string& kind, int count) {
    file_.addVariable(kind + "_status", {count}, NetcdfType::Int, [this](NetcdfValues& values) {
      for (std::size_t p = 0; p < tags_.size(); ++p) values.put(1);
    });
    file_.addVariable(kind + "_prop1", {count}, NetcdfType::Int,
                      [this](NetcdfValues& values) {
                        for (const std::int32_t tag : tags_) values.put(tag);
                      },
                      {"name", "ID"});
  }

  void addNames(const std::string& variable, int count, const std::vector<std::string>& names) {
    file_.addVariable(variable, {count, nameWidth_}, NetcdfType::Char, [&names](NetcdfValues& values) {
      for (const std::string& name : names) values.put(name, kNameWidth);
    });
  }

  inline static const std::vector<std::string> kAxes{"x", "y", "z"};
  const SolverMesh& mesh_;
  std::vector<std::int32_t> tags_;
  std::vector<std::string> names_, sideNames_;
  std::vector<std::int32_t> place_;  ///< of each tet among the elements of the file, from 1
  int nameWidth_ = 0;
  ClassicNetcdf file_;
};

}  // namespace

void writeExodus(const TissueMesh& tissues, const std::filesystem::path& file,
                 const WriteMeshOptions& options) {
  if (tissues.mesh.tets.empty()) throw std::runtime_error("the format has no room for a mesh without tets");
  const SolverMesh mesh(tissues, options);
  ExodusWriter(mesh, options).write(file);
}

}  // namespace sinew
