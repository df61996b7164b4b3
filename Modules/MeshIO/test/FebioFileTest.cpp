#include "FebioFile.h"
#include "SolverMeshes.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <set>
#include <sstream>

namespace sinew {
namespace {

std::vector<int> numbersIn(const std::string& text) {
  std::vector<int> numbers;
  std::istringstream stream(text);
  for (std::string word; std::getline(stream, word, ',');) numbers.push_back(std::stoi(word));
  return numbers;
}

class FebioFile : public ::testing::Test {
 protected:
  vtkXMLDataElement* write(const TissueMesh& mesh, const WriteMeshOptions& options = {}) {
    writeMesh(mesh, folder_ / "a.feb", options);
    text_ = test::readBytes(folder_ / "a.feb");
    parser_->SetIgnoreCharacterData(0);
    std::istringstream stream(text_);
    parser_->SetStream(&stream);
    if (parser_->Parse() == 0) throw std::runtime_error("no XML");
    return parser_->GetRootElement();
  }
  /// The children of this tag, in order.
  static std::vector<vtkXMLDataElement*> children(vtkXMLDataElement* parent, const std::string& tag) {
    std::vector<vtkXMLDataElement*> found;
    for (int i = 0; i < parent->GetNumberOfNestedElements(); ++i)
      if (parent->GetNestedElement(i)->GetName() == tag) found.push_back(parent->GetNestedElement(i));
    return found;
  }
  static vtkXMLDataElement* child(vtkXMLDataElement* parent, const std::string& tag) {
    return children(parent, tag).at(0);
  }
  test::TempFolder folder_;
  std::string text_;
  vtkNew<vtkXMLDataParser> parser_;
};

TEST_F(FebioFile, SectionsAreThoseOfVersion4InOrder) {
  vtkXMLDataElement* root = write(test::twoHalves());
  EXPECT_STREQ(root->GetName(), "febio_spec");
  EXPECT_STREQ(root->GetAttribute("version"), "4.0");
  std::vector<std::string> sections;
  for (int i = 0; i < root->GetNumberOfNestedElements(); ++i)
    sections.push_back(root->GetNestedElement(i)->GetName());
  EXPECT_EQ(sections, (std::vector<std::string>{"Module", "Material", "Mesh", "MeshDomains"}));
  EXPECT_STREQ(child(root, "Module")->GetAttribute("type"), "solid");
}

TEST_F(FebioFile, EveryTissueIsAPartWithASurfaceADomainAndAMaterial) {
  const TissueMesh mesh = test::twoHalves();
  vtkXMLDataElement* root = write(mesh);
  vtkXMLDataElement* section = child(root, "Mesh");
  EXPECT_EQ(children(child(section, "Nodes"), "node").size(), mesh.mesh.nodes.size());
  const auto parts = children(section, "Elements"), surfaces = children(section, "Surface");
  const auto domains = children(child(root, "MeshDomains"), "SolidDomain");
  const auto materials = children(child(root, "Material"), "material");
  ASSERT_EQ(parts.size(), 2u);
  ASSERT_EQ(surfaces.size(), 2u);
  ASSERT_EQ(domains.size(), 2u);
  ASSERT_EQ(materials.size(), 2u);
  for (int p = 0; p < 2; ++p) {
    const TissueRegion& region = mesh.regions[p];
    EXPECT_EQ(parts[p]->GetAttribute("name"), region.name);
    EXPECT_STREQ(parts[p]->GetAttribute("type"), "tet4");
    EXPECT_EQ(surfaces[p]->GetAttribute("name"), region.name + "_surface");
    EXPECT_EQ(domains[p]->GetAttribute("name"), region.name);
    EXPECT_EQ(domains[p]->GetAttribute("mat"), region.name);
    EXPECT_EQ(materials[p]->GetAttribute("name"), region.name);
    for (vtkXMLDataElement* element : children(parts[p], "elem")) {
      const std::size_t t = std::stoul(element->GetAttribute("id")) - 1;
      EXPECT_EQ(mesh.mesh.labels[t], region.label);
      const Tet& tet = mesh.mesh.tets[t];
      EXPECT_EQ(numbersIn(element->GetCharacterData()),
                (std::vector<int>{tet[0] + 1, tet[1] + 1, tet[2] + 1, tet[3] + 1}));
    }
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (vtkXMLDataElement* triangle : children(surfaces[p], "tri3")) {
      const std::vector<int> n = numbersIn(triangle->GetCharacterData());
      ASSERT_EQ(n.size(), 3u);
      const auto x = [&](int corner) { return mesh.mesh.nodes[n[corner] - 1]; };
      area += (x(1) - x(0)).cross(x(2) - x(0));
    }
    EXPECT_LT(area.norm(), 1e-9);  // closed
  }
}

TEST_F(FebioFile, QuadraticTetsAndTrianglesAgree) {
  WriteMeshOptions options;
  options.quadratic = true;
  vtkXMLDataElement* section = child(write(test::namedTets({"a"}), options), "Mesh");
  vtkXMLDataElement* part = child(section, "Elements");
  EXPECT_STREQ(part->GetAttribute("type"), "tet10");
  const std::vector<int> n = numbersIn(child(part, "elem")->GetCharacterData());
  ASSERT_EQ(n.size(), 10u);
  // The faces of FEBio's tet10 (FEElement.cpp): corners, then the middles 01, 12, 20.
  const std::set<std::vector<int>> faces{{n[0], n[1], n[3], n[4], n[8], n[7]},
                                         {n[1], n[2], n[3], n[5], n[9], n[8]},
                                         {n[0], n[3], n[2], n[7], n[9], n[6]},
                                         {n[0], n[2], n[1], n[6], n[5], n[4]}};
  const auto turned = [](std::vector<int> f) {  // so that the corner with the smallest number is first
    while (f[0] != std::min({f[0], f[1], f[2]})) f = {f[1], f[2], f[0], f[4], f[5], f[3]};
    return f;
  };
  std::set<std::vector<int>> expected, found;
  for (const auto& face : faces) expected.insert(turned(face));
  for (vtkXMLDataElement* triangle : children(child(section, "Surface"), "tri6"))
    found.insert(turned(numbersIn(triangle->GetCharacterData())));
  EXPECT_EQ(found, expected);
}

TEST_F(FebioFile, SaysItsUnit) {
  for (const auto& [perMm, system, unit] :
       {std::tuple(1.0, "mm-N-s", "mm"), std::tuple(0.1, "CGS", "cm"), std::tuple(0.001, "SI", "m")}) {
    WriteMeshOptions options;
    options.perMm = perMm;
    vtkXMLDataElement* root = write(test::namedTets({"a"}), options);
    EXPECT_STREQ(child(child(root, "Module"), "units")->GetCharacterData(), system);
    EXPECT_NE(text_.find("<!-- Sinew mesh, unit " + std::string(unit) + ", space LPS -->"),
              std::string::npos);
  }
}

TEST_F(FebioFile, HardNamesAreLegalAndDistinct) {
  const auto names = test::hardNames();
  vtkXMLDataElement* root = write(test::namedTets(names));
  std::set<std::string> found;
  for (vtkXMLDataElement* part : children(child(root, "Mesh"), "Elements")) {
    const std::string name = part->GetAttribute("name");
    EXPECT_TRUE(found.insert(name).second) << name;
    EXPECT_LT(name.size() + std::string("_surface").size(), 256u);  // FEBio Studio's buffers
    EXPECT_EQ(name.find_first_of(",:.@[]\"&<>'"), std::string::npos) << name;
  }
  EXPECT_EQ(found.size(), names.size());
  EXPECT_TRUE(found.contains("M\u00fcller/Gro\u00df"));
}

}  // namespace
}  // namespace sinew
