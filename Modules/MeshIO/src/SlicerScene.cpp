#include "sinew/MeshIO/SlicerScene.h"

#include "FileFailure.h"
#include "MeshFormatTable.h"

#include <vtk_pugixml.h>
#include <vtk_utf8.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <utility>

namespace sinew {
namespace {

namespace fs = std::filesystem;

/// Without a revision, the last number, Slicer takes coordinates for RAS that no storage node says to be LPS.
constexpr const char* kVersion = "Slicer 5.6.2 32448";

/// The six characters that vtkMRMLNode::URLDecodeString knows; any other code it would leave as it is.
constexpr std::array<std::pair<char, std::string_view>, 6> kUrlCodes{
    {{'%', "%25"}, {' ', "%20"}, {'\'', "%27"}, {'>', "%3E"}, {'<', "%3C"}, {'"', "%22"}}};

std::string urlEncoded(const fs::path& file) {
  std::string text;
  for (const char c : file.generic_string()) {
    const auto* code = std::ranges::find(kUrlCodes, c, &std::pair<char, std::string_view>::first);
    code != kUrlCodes.end() ? text.append(code->second) : text.append(1, c);
  }
  return text;
}

bool isXmlCharacter(std::uint32_t c) {
  return c == '\t' || c == '\n' || c == '\r' || (c >= ' ' && c != 0xFFFE && c != 0xFFFF);
}

/// The text without what XML 1.0 has no way to write: control characters, and bytes that are no UTF-8.
std::string xmlText(std::string_view text) {
  std::string valid, result;
  utf8::replace_invalid(text.begin(), text.end(), std::back_inserter(valid), '?');
  for (auto at = valid.begin(); at != valid.end();) {
    const std::uint32_t c = utf8::next(at, valid.end());
    utf8::append(isXmlCharacter(c) ? c : '?', std::back_inserter(result));
  }
  return result;
}

std::string number(double value) {
  std::array<char, 32> digits{};
  return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string numbers(const std::array<double, 3>& values) {
  return number(values[0]) + " " + number(values[1]) + " " + number(values[2]);
}

/// Adds nodes to a scene, each kind with ids counted from 1, as Slicer has them.
class SceneWriter {
 public:
  explicit SceneWriter(const SlicerScene& scene) : space_(toString(scene.space)) {
    pugi::xml_node declaration = document_.append_child(pugi::node_declaration);
    set(declaration, {{"version", "1.0"}, {"encoding", "UTF-8"}});
    root_ = document_.append_child("MRML");
    set(root_, {{"version", kVersion}, {"userTags", ""}});
    for (const SceneModel& model : scene.models) add(model);
    if (scene.segmentation) add(*scene.segmentation);
  }

  bool save(const fs::path& file) const {
    return document_.save_file(file.c_str(), " ", pugi::format_default, pugi::encoding_utf8);
  }

 private:
  using Attributes = std::vector<std::pair<const char*, std::string>>;

  static void set(pugi::xml_node node, const Attributes& attributes) {
    for (const auto& [name, value] : attributes) node.append_attribute(name) = value.c_str();
  }

  void addNode(const char* element, const Attributes& attributes) {
    set(root_.append_child(element), attributes);
  }

  void add(const SceneModel& model) {
    const std::string number = std::to_string(++models_), name = xmlText(model.name);
    const std::string id = "vtkMRMLModelNode" + number, storage = "vtkMRMLModelStorageNode" + number,
                      display = "vtkMRMLModelDisplayNode" + number;
    addNode("ModelStorage", {{"id", storage},
                             {"name", name + " storage"},
                             {"fileName", urlEncoded(model.file)},
                             {"coordinateSystem", space_}});
    Attributes look{{"id", display},
                    {"name", name + " display"},
                    {"color", numbers(model.color)},
                    {"opacity", sinew::number(model.opacity)},
                    {"visibility", "true"},
                    {"visibility2D", "true"},
                    {"edgeVisibility", "true"},
                    {"scalarVisibility", model.colorTable ? "true" : "false"}};
    if (model.colorTable)
      look.insert(look.end(), {{"activeScalarName", "labels"},
                               {"activeAttributeLocation", "cell"},
                               {"colorNodeID", addColorTable(*model.colorTable, name)},
                               {"scalarRangeFlag", "UseColorNode"}});
    addNode("ModelDisplay", look);
    addNode("Model", {{"id", id}, {"name", name}, {"storageNodeRef", storage}, {"displayNodeRef", display}});
  }

  /// @return its id
  std::string addColorTable(const fs::path& file, const std::string& name) {
    constexpr const char* kFromFile = "14";  // vtkMRMLColorTableNode::File
    const std::string number = std::to_string(++colorTables_);
    const std::string id = "vtkMRMLColorTableNode" + number,
                      storage = "vtkMRMLColorTableStorageNode" + number;
    addNode("ColorTableStorage",
            {{"id", storage}, {"name", name + " colors storage"}, {"fileName", urlEncoded(file)}});
    addNode("ColorTable",
            {{"id", id}, {"name", name + " colors"}, {"type", kFromFile}, {"storageNodeRef", storage}});
    return id;
  }

  void add(const SceneSegmentation& segmentation) {
    const std::string id = "vtkMRMLSegmentationNode1", storage = "vtkMRMLSegmentationStorageNode1",
                      display = "vtkMRMLSegmentationDisplayNode1", name = xmlText(segmentation.name);
    addNode("SegmentationStorage",
            {{"id", storage}, {"name", name + " storage"}, {"fileName", urlEncoded(segmentation.file)}});
    addNode("SegmentationDisplay", {{"id", display}, {"name", name + " display"}, {"visibility", "true"}});
    addNode("Segmentation",
            {{"id", id}, {"name", name}, {"storageNodeRef", storage}, {"displayNodeRef", display}});
  }

  std::string space_;
  pugi::xml_document document_;
  pugi::xml_node root_;
  int models_ = 0, colorTables_ = 0;
};

}  // namespace

void writeSlicerScene(const SlicerScene& scene, const fs::path& file) {
  if (!SceneWriter(scene).save(file)) fail(file, "cannot be written");
}

}  // namespace sinew
