#include "CoordinatesNote.h"
#include "GmshFile.h"
#include "GmshScanner.h"
#include "Regions.h"

#include <limits>
#include <map>
#include <set>
#include <utility>

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr std::int32_t kTet4 = 4, kTet10 = 11;

/// Nodes of the element types 1, 2, ...; 0: not known here.
constexpr std::array<std::uint8_t, 31> kNodesOfType{2,  3,  4,  4, 8, 6,  5,  3,  6, 9,  10,
                                                    27, 18, 14, 1, 8, 20, 15, 13, 9, 10, 12,
                                                    15, 15, 21, 4, 5, 6,  20, 35, 56};
constexpr std::int32_t kMostTags = 1000;  ///< of one element; partitioned meshes have some more than two

class GmshReader {
 public:
  GmshReader(std::string_view bytes, const fs::path& file) : scan_(bytes, file), file_(file) {}

  TissueMesh read() {
    readFormat();
    for (std::string_view section = scan_.word(); !section.empty(); section = scan_.word()) {
      if (!section.starts_with('$')) scan_.damaged("expected a section, $...");
      section.remove_prefix(1);
      scan_.line();
      if (section == "PhysicalNames")
        readNames();
      else if (section == "Nodes")
        readNodes();
      else if (section == "Elements")
        readElements();
      else if (section == "Comments")
        readComments();
      else
        scan_.rest(section);
    }
    if (mesh_.mesh.tets.empty()) fail(file_, "has no tetrahedra");
    nameNodesByPlace();
    return finished();
  }

 private:
  void readFormat() {
    if (scan_.word() != "$MeshFormat") scan_.damaged("not a Gmsh file: it does not begin with $MeshFormat");
    const auto version = scan_.word();
    if (!version.starts_with("2"))
      fail(file_, "is Gmsh " + std::string(version.substr(0, 8)) +
                      "; 2.2 can be read: gmsh FILE -save -format msh22 -o FILE2.msh makes one");
    const auto fileType = scan_.text<int>();
    scan_.text<int>();  // bytes of a double, always 8
    scan_.line();
    scan_.binary = fileType == 1;
    if (scan_.binary && scan_.number<std::int32_t>() != 1)
      fail(file_, "has its bytes in another order than this machine");
    scan_.end("MeshFormat");
  }

  void readNames() {
    constexpr int kVolume = 3;
    const std::size_t names = scan_.count(4);
    for (std::size_t i = 0; i < names; ++i) {
      const auto dimension = scan_.text<int>();
      const auto tag = scan_.text<std::int32_t>();
      const std::string_view line = scan_.line();
      const std::size_t begin = line.find('"'), end = line.rfind('"');
      if (begin == end) scan_.damaged("expected a name in quotes");
      if (dimension == kVolume) names_[tag] = line.substr(begin + 1, end - begin - 1);
    }
    scan_.end("PhysicalNames");
  }

  void readNodes() {
    const std::size_t nodes = scan_.count(scan_.binary ? 28 : 8);
    for (std::size_t i = 0; i < nodes; ++i) {
      const auto id = scan_.number<std::int32_t>();
      inOrder_ = inOrder_ && static_cast<std::size_t>(id) == ids_.size() + 1;
      ids_.push_back(id);
      Eigen::Vector3d& x = mesh_.mesh.nodes.emplace_back();
      for (int axis = 0; axis < 3; ++axis) x[axis] = scan_.number<double>();
      if (!x.allFinite()) scan_.damaged("node " + std::to_string(id) + " has no finite coordinates");
    }
    scan_.end("Nodes");
  }

  void readElements() {
    const std::size_t elements = scan_.count(scan_.binary ? 8 : 6);
    for (std::size_t done = 0; done < elements;)
      done += scan_.binary ? readBlock(elements - done) : readLine();
    scan_.end("Elements");
  }

  /// @return 1
  std::size_t readLine() {
    scan_.text<std::int64_t>();  // its number
    const auto type = scan_.text<std::int32_t>();
    const std::int32_t label = readLabel(scan_.text<std::int32_t>());
    if (type == kTet4 || type == kTet10) addTet(label);
    scan_.line();
    return 1;
  }

  /// Elements of one kind. @return how many
  std::size_t readBlock(std::size_t most) {
    const auto type = scan_.number<std::int32_t>();
    const auto count = scan_.number<std::int32_t>(), tags = scan_.number<std::int32_t>();
    if (type < 1 || type > std::ssize(kNodesOfType))
      scan_.damaged("unknown type of element " + std::to_string(type));
    if (count < 1 || static_cast<std::size_t>(count) > most)
      scan_.damaged("a block of elements has a wrong count");
    const int nodes = kNodesOfType[type - 1];
    for (std::int32_t i = 0; i < count; ++i) {
      scan_.number<std::int32_t>();  // its number
      const std::int32_t label = readLabel(tags);
      const bool isTet = type == kTet4 || type == kTet10;
      if (isTet) addTet(label);
      for (int k = isTet ? 4 : 0; k < nodes; ++k) scan_.number<std::int32_t>();
    }
    return static_cast<std::size_t>(count);
  }

  /// The first tag, the physical one, unless it is 0, which means none; then the second.
  std::int32_t readLabel(std::int32_t tags) {
    if (tags < 0 || tags > kMostTags) scan_.damaged("an element has " + std::to_string(tags) + " tags");
    std::int32_t label = 0;
    for (std::int32_t i = 0; i < tags; ++i) {
      const auto tag = scan_.number<std::int32_t>();
      if (label == 0 && i < 2) label = tag;
    }
    return tags == 0 ? 1 : label;
  }

  void addTet(std::int32_t label) {
    Tet& tet = mesh_.mesh.tets.emplace_back();
    for (std::int32_t& node : tet) node = scan_.number<std::int32_t>();
    mesh_.mesh.labels.push_back(label);
  }

  void readComments() {
    std::string_view comments = scan_.rest("Comments");
    while (!comments.empty()) {
      const std::size_t end = std::min(comments.find('\n'), comments.size() - 1);
      if (const auto note = readCoordinatesNote(comments.substr(0, end))) coordinates_ = *note;
      comments.remove_prefix(end + 1);
    }
  }

  /// Nodes are named by their numbers, which may have gaps and come in any order.
  void nameNodesByPlace() {
    std::vector<std::pair<std::int32_t, std::int32_t>> places;
    if (!inOrder_) {
      for (std::size_t n = 0; n < ids_.size(); ++n)
        places.emplace_back(ids_[n], static_cast<std::int32_t>(n));
      std::ranges::sort(places);
      const auto twice =
          std::ranges::adjacent_find(places, {}, [](const auto& place) { return place.first; });
      if (twice != places.end()) fail(file_, "has two nodes " + std::to_string(twice->first));
    }
    const auto placeOf = [&](std::int32_t id) -> std::int32_t {
      if (inOrder_) return id >= 1 && static_cast<std::size_t>(id) <= ids_.size() ? id - 1 : -1;
      const auto found =
          std::ranges::lower_bound(places, std::pair(id, std::numeric_limits<std::int32_t>::min()));
      return found != places.end() && found->first == id ? found->second : -1;
    };
    for (Tet& tet : mesh_.mesh.tets)
      for (std::int32_t& node : tet) {
        const std::int32_t id = std::exchange(node, placeOf(node));
        if (node < 0) fail(file_, "a tetrahedron names node " + std::to_string(id) + ", which is not there");
      }
  }

  /// Without the nodes of other elements, in LPS mm, and with the tissues' names.
  TissueMesh finished() {
    TetMesh& mesh = mesh_.mesh;
    std::vector<std::int32_t> place(mesh.nodes.size(), -1);
    for (const Tet& tet : mesh.tets)
      for (const std::int32_t node : tet) place[node] = 0;
    std::int32_t used = 0;
    for (std::size_t n = 0; n < place.size(); ++n) {
      if (place[n] < 0) continue;
      mesh.nodes[used] = fromFile(mesh.nodes[n], coordinates_);
      if (!mesh.nodes[used].allFinite()) fail(file_, "has coordinates that its unit takes out of range");
      place[n] = used++;
    }
    mesh.nodes.resize(static_cast<std::size_t>(used));
    for (Tet& tet : mesh.tets)
      for (std::int32_t& node : tet) node = place[node];
    for (const std::int32_t label : std::set(mesh.labels.begin(), mesh.labels.end()))
      mesh_.regions.push_back(names_.contains(label) ? TissueRegion{label, names_[label]}
                                                     : unnamedRegion(label));
    return std::move(mesh_);
  }

  GmshScanner scan_;
  const fs::path& file_;
  TissueMesh mesh_;
  std::vector<std::int32_t> ids_;  ///< of the nodes
  bool inOrder_ = true;            ///< ids_ are 1, 2, 3 ...
  std::map<std::int32_t, std::string> names_;
  WriteMeshOptions coordinates_;
};

}  // namespace

TissueMesh readGmsh(const fs::path& file, const ReadMeshOptions& /*it has no arrays*/) {
  std::string bytes(static_cast<std::size_t>(fs::file_size(file)), '\0');
  if (!std::ifstream(file, std::ios::binary).read(bytes.data(), std::ssize(bytes)))
    fail(file, "cannot be read");
  return GmshReader(bytes, file).read();
}

}  // namespace sinew
