#include "ExampleMesh.h"
#include "sinew/MeshIO/SlicerScene.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <set>
#include <utility>

namespace sinew {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != text.npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// As vtkMRMLNode::URLDecodeString does it, in its order.
std::string slicerDecodes(std::string text) {
  for (const auto& [code, character] : std::vector<std::pair<std::string, std::string>>{
           {"%22", "\""}, {"%3C", "<"}, {"%3E", ">"}, {"%27", "'"}, {"%20", " "}, {"%25", "%"}})
    text = replaced(text, code, character);
  return text;
}

std::string attribute(vtkXMLDataElement* element, const char* name) {
  const char* value = element->GetAttribute(name);
  return value != nullptr ? value : "(none)";
}

/// A scene file, parsed by expat as Slicer does, with every file that it names beside it.
class SceneFile {
 public:
  explicit SceneFile(const SlicerScene& scene) {
    for (const SceneModel& model : scene.models) {
      writeMesh(test::twoTissues(), folder_ / model.file);
      if (model.colorTable) test::writeBytes(folder_ / *model.colorTable, "1 bone 255 128 0 255\n");
    }
    if (scene.segmentation) test::writeBytes(folder_ / scene.segmentation->file, "NRRD0004\n");
    writeSlicerScene(scene, file());
    root_ = vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file().c_str()));
  }

  fs::path file() const { return folder_ / "scene.mrml"; }
  fs::path folder() const { return folder_.path(); }
  vtkXMLDataElement* root() const { return root_; }

  std::vector<vtkXMLDataElement*> nodes(const std::string& name = "") const {
    std::vector<vtkXMLDataElement*> found;
    for (int n = 0; n < root_->GetNumberOfNestedElements(); ++n)
      if (name.empty() || root_->GetNestedElement(n)->GetName() == name)
        found.push_back(root_->GetNestedElement(n));
    return found;
  }
  vtkXMLDataElement* withId(const std::string& id) const {
    for (vtkXMLDataElement* node : nodes())
      if (attribute(node, "id") == id) return node;
    return nullptr;
  }

 private:
  TempFolder folder_;
  vtkSmartPointer<vtkXMLDataElement> root_;
};

const std::string kHardName = "a <b> & \"c\" 'd' %20 Müskel\n" + std::string(200, 'x');

SlicerScene exampleScene() {
  return {{{"bone.vtu", "bone", {1, 0.5, 0}, 0.25},
           {"it's 100%20 \"big\" Müskel.vtu", kHardName, {0.1, 0.2, 0.3}},
           {"all.vtu", "all", {0.5, 0.5, 0.5}, 1, "all labels.ctbl"}},
          SceneSegmentation{"scan of me.seg.nrrd", "scan"}};
}

TEST(SlicerScene, M7_IsWellFormedAndItsVersionHasARevision) {
  const SceneFile scene(exampleScene());
  ASSERT_NE(scene.root(), nullptr);
  EXPECT_STREQ(scene.root()->GetName(), "MRML");
  EXPECT_EQ(attribute(scene.root(), "version"), "Slicer 5.6.2 32448");
  EXPECT_TRUE(test::readBytes(scene.file()).starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\"?>"));
}

TEST(SlicerScene, M7_IdsAreUniqueAndReferencesLeadSomewhere) {
  const SceneFile scene(exampleScene());
  std::set<std::string> ids;
  for (vtkXMLDataElement* node : scene.nodes()) EXPECT_TRUE(ids.insert(attribute(node, "id")).second);
  EXPECT_EQ(ids.size(), 3u * 3 + 2 + 3);
  for (vtkXMLDataElement* node : scene.nodes())
    for (const char* reference : {"storageNodeRef", "displayNodeRef", "colorNodeID"})
      if (node->GetAttribute(reference) != nullptr) {
        EXPECT_TRUE(ids.contains(attribute(node, reference))) << reference;
      }
}

TEST(SlicerScene, M7_EveryFileIsThereAfterUrlDecoding) {
  const SceneFile scene(exampleScene());
  int files = 0;
  for (vtkXMLDataElement* node : scene.nodes())
    if (const char* file = node->GetAttribute("fileName")) {
      ++files;
      EXPECT_EQ(std::string(file).find_first_of(" '\"<>"), std::string::npos) << file;
      EXPECT_TRUE(fs::exists(scene.folder() / slicerDecodes(file))) << file;
    }
  EXPECT_EQ(files, 5);
}

TEST(SlicerScene, M7_EveryTissueIsAModelWithItsNameAndColour) {
  const SceneFile scene(exampleScene());
  const auto models = scene.nodes("Model");
  ASSERT_EQ(models.size(), 3u);
  EXPECT_EQ(attribute(models[0], "name"), "bone");
  EXPECT_EQ(attribute(models[1], "name"), kHardName);
  vtkXMLDataElement* display = scene.withId(attribute(models[0], "displayNodeRef"));
  EXPECT_EQ(attribute(display, "color"), "1 0.5 0");
  EXPECT_EQ(attribute(display, "opacity"), "0.25");
  EXPECT_EQ(attribute(display, "scalarVisibility"), "false");
  vtkXMLDataElement* storage = scene.withId(attribute(models[1], "storageNodeRef"));
  EXPECT_EQ(slicerDecodes(attribute(storage, "fileName")), exampleScene().models[1].file);
}

TEST(SlicerScene, M7_EveryModelStorageSaysTheSpace) {
  for (const Space space : {Space::Lps, Space::Ras}) {
    SlicerScene scene = exampleScene();
    scene.space = space;
    const SceneFile file(scene);
    for (vtkXMLDataElement* storage : file.nodes("ModelStorage"))
      EXPECT_EQ(attribute(storage, "coordinateSystem"), space == Space::Lps ? "LPS" : "RAS");
  }
}

TEST(SlicerScene, ACombinedMeshIsColouredByItsTable) {
  const SceneFile scene(exampleScene());
  vtkXMLDataElement* display = scene.withId(attribute(scene.nodes("Model")[2], "displayNodeRef"));
  EXPECT_EQ(attribute(display, "scalarVisibility"), "true");
  EXPECT_EQ(attribute(display, "activeScalarName"), "labels");
  EXPECT_EQ(attribute(display, "activeAttributeLocation"), "cell");
  EXPECT_EQ(attribute(display, "scalarRangeFlag"), "UseColorNode");
  vtkXMLDataElement* table = scene.withId(attribute(display, "colorNodeID"));
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(attribute(table, "type"), "14");
  EXPECT_EQ(attribute(scene.withId(attribute(table, "storageNodeRef")), "fileName"), "all%20labels.ctbl");
}

TEST(SlicerScene, NamesThatXmlCannotHoldAreMended) {
  SlicerScene scene = exampleScene();
  scene.models[0].name = std::string("a\x01") + "b\xff" + "c\xed\xa0\x80" + "d\xef\xbf\xbf";
  const SceneFile file(scene);
  ASSERT_NE(file.root(), nullptr);
  const std::string name = attribute(file.nodes("Model")[0], "name");
  EXPECT_TRUE(name.starts_with("a?b?c?")) << name;
  EXPECT_TRUE(name.ends_with("d?")) << name;
}

TEST(SlicerScene, AnEmptySceneAndAnUnwritablePlace) {
  EXPECT_NE(SceneFile({}).root(), nullptr);
  const TempFolder folder;
  const std::string message =
      test::messageOf<std::runtime_error>([&] { writeSlicerScene({}, folder / "none" / "a.mrml"); });
  EXPECT_EQ(message, (folder / "none" / "a.mrml").string() + ": cannot be written");
}

}  // namespace
}  // namespace sinew
