#include "AbaqusFile.h"
#include "SolverMeshes.h"
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

namespace sinew {
namespace {

/// A card with its lines of data, as numbers and as they stand.
struct Card {
  std::string keyword;                         ///< as `*NODE`
  std::map<std::string, std::string> options;  ///< as NSET -> Nall
  std::vector<std::vector<std::string>> data;
};

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; std::getline(stream, word, ',');)
    words.push_back(word.substr(word.find_first_not_of(' ')));
  return words;
}

std::vector<Card> cardsOf(const std::string& text) {
  std::vector<Card> cards;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    EXPECT_LE(line.size(), 256u) << line;
    if (line.starts_with("**")) continue;
    const auto words = split(line);
    if (!line.starts_with("*")) {
      EXPECT_LE(words.size(), 16u);
      cards.back().data.push_back(words);
      continue;
    }
    cards.push_back({words[0], {}, {}});
    for (std::size_t w = 1; w < words.size(); ++w) {
      const std::size_t equals = words[w].find('=');
      cards.back().options[words[w].substr(0, equals)] = words[w].substr(equals + 1);
    }
  }
  return cards;
}

std::set<int> numbersOf(const Card& card) {
  std::set<int> numbers;
  for (const auto& line : card.data)
    for (const std::string& word : line) EXPECT_TRUE(numbers.insert(std::stoi(word)).second) << word;
  return numbers;
}

class AbaqusFile : public ::testing::Test {
 protected:
  std::string write(const TissueMesh& mesh, const WriteMeshOptions& options = {}) {
    writeMesh(mesh, folder_ / "a.inp", options);
    return test::readBytes(folder_ / "a.inp");
  }
  const Card& find(const std::string& keyword, const std::string& option, const std::string& value) {
    const auto found = std::ranges::find_if(cards_, [&](const Card& card) {
      return card.keyword == keyword && card.options.contains(option) && card.options.at(option) == value;
    });
    if (found == cards_.end()) throw std::runtime_error("no " + keyword + " " + value);
    return *found;
  }
  test::TempFolder folder_;
  std::vector<Card> cards_;
};

TEST_F(AbaqusFile, HoldsNodesAndElementsOfEveryTissue) {
  const TissueMesh mesh = test::twoHalves();
  cards_ = cardsOf(write(mesh));
  const Card& nodes = find("*NODE", "NSET", "Nall");
  ASSERT_EQ(nodes.data.size(), mesh.mesh.nodes.size());
  for (std::size_t n = 0; n < nodes.data.size(); ++n) {
    EXPECT_EQ(nodes.data[n][0], std::to_string(n + 1));
    for (int axis = 0; axis < 3; ++axis)  // 12 digits of 700
      EXPECT_NEAR(std::stod(nodes.data[n][1 + axis]), mesh.mesh.nodes[n][axis], 1e-9);
  }
  std::size_t elements = 0;
  for (const auto& [name, label] : {std::pair("left_half", 7), std::pair("right_half", 3)}) {
    const Card& card = find("*ELEMENT", "ELSET", name);
    EXPECT_EQ(card.options.at("TYPE"), "C3D4");
    std::set<int> nodesOfTissue;
    for (const auto& line : card.data) {
      const std::size_t t = std::stoul(line[0]) - 1;
      EXPECT_EQ(mesh.mesh.labels[t], label);
      for (int k = 0; k < 4; ++k) {
        EXPECT_EQ(std::stoi(line[1 + k]), mesh.mesh.tets[t][k] + 1);
        nodesOfTissue.insert(std::stoi(line[1 + k]));
      }
    }
    elements += card.data.size();
    EXPECT_EQ(numbersOf(find("*NSET", "NSET", std::string(name) + "_nodes")), nodesOfTissue);
  }
  EXPECT_EQ(elements, mesh.mesh.tets.size());
  EXPECT_EQ(find("*ELSET", "ELSET", "Eall").data.size(), 2u);
}

TEST_F(AbaqusFile, SurfacesAreTheTissuesBoundaries) {
  const TissueMesh mesh = test::twoHalves();
  cards_ = cardsOf(write(mesh));
  constexpr int kFaces[4][3] = {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}};  // S1 to S4 in CalculiX's manual
  for (const std::string name : {"left_half", "right_half"}) {
    std::map<std::set<int>, int> facesOfTissue;
    for (const auto& line : find("*ELEMENT", "ELSET", name).data)
      for (const auto& [i, j, k] : kFaces)
        ++facesOfTissue[{std::stoi(line[1 + i]), std::stoi(line[1 + j]), std::stoi(line[1 + k])}];
    const auto once = std::ranges::count_if(facesOfTissue, [](const auto& face) { return face.second == 1; });
    std::set<int> nodes;
    const Card& surface = find("*SURFACE", "NAME", name + "_surface");
    EXPECT_EQ(surface.options.at("TYPE"), "ELEMENT");
    for (const auto& line : surface.data) {
      const Tet& tet = mesh.mesh.tets[std::stoul(line[0]) - 1];
      ASSERT_EQ(line[1][0], 'S');
      const auto& [i, j, k] = kFaces[line[1][1] - '1'];
      const std::set<int> face{tet[i] + 1, tet[j] + 1, tet[k] + 1};
      EXPECT_EQ(facesOfTissue.at(face), 1);
      nodes.insert(face.begin(), face.end());
    }
    EXPECT_EQ(std::ssize(surface.data), once);
    EXPECT_EQ(numbersOf(find("*NSET", "NSET", name + "_boundary")), nodes);
  }
}

TEST_F(AbaqusFile, QuadraticTetsHaveTheirMiddlesInOrder) {
  WriteMeshOptions options;
  options.quadratic = true;
  cards_ = cardsOf(write(test::twoHalves(), options));
  const Card& nodes = find("*NODE", "NSET", "Nall");
  const auto place = [&](const std::string& number) {
    const auto& line = nodes.data[std::stoul(number) - 1];
    return Eigen::Vector3d(std::stod(line[1]), std::stod(line[2]), std::stod(line[3]));
  };
  // CalculiX's manual: 5 between 1 and 2, 6 between 2 and 3, 7 between 3 and 1, 8, 9, 10 between 4 and 1, 2,
  // 3
  constexpr int kEdges[6][2] = {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}};
  const Card& card = find("*ELEMENT", "ELSET", "left_half");
  EXPECT_EQ(card.options.at("TYPE"), "C3D10");
  int straight = 0;
  for (const auto& line : card.data)
    for (int e = 0; e < 6; ++e) {
      const Eigen::Vector3d a = place(line[kEdges[e][0]]), b = place(line[kEdges[e][1]]);
      const double away = (place(line[5 + e]) - (a + b) / 2).norm();
      EXPECT_LE(away, 0.25 * (b - a).norm());  // bent, and of no other edge
      straight += away < 1e-9;
    }
  EXPECT_GT(straight, 0);
}

TEST_F(AbaqusFile, NumbersFitIntoTwentyCharacters) {
  TissueMesh mesh = test::namedTets({"a"});
  mesh.mesh.nodes[1] = {-1.2345678901234567e-5, -123456.78901234567, 1.0 / 3};
  cards_ = cardsOf(write(mesh));
  for (const auto& line : find("*NODE", "NSET", "Nall").data)
    for (const std::string& word : line) EXPECT_LE(word.size(), 20u) << word;
}

TEST_F(AbaqusFile, SaysItsUnit) {
  WriteMeshOptions options;
  options.perMm = 0.001;
  const std::string text = write(test::namedTets({"a"}), options);
  EXPECT_TRUE(text.starts_with("** Sinew mesh, unit m, space LPS\n"));
  EXPECT_NE(text.find("\n2,0.001,0,0\n"), std::string::npos);
}

TEST_F(AbaqusFile, HardNamesAreLegalAndDistinct) {
  const auto names = test::hardNames();
  const std::string text = write(test::namedTets(names));
  cards_ = cardsOf(text);
  std::map<std::string, std::set<std::string>>
      found;  // by kind of set, in upper case as the solvers see them
  for (const Card& card : cards_)
    for (const std::string option : {"NSET", "ELSET", "NAME"}) {
      if (!card.options.contains(option)) continue;
      std::string name = card.options.at(option);
      EXPECT_LE(name.size(), 80u);
      EXPECT_TRUE(std::isalpha(static_cast<unsigned char>(name[0]))) << name;
      for (char& c : name) {
        EXPECT_TRUE(std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-') << name;
        c = static_cast<char>(std::toupper(c));
      }
      EXPECT_TRUE(found[option].insert(name).second) << name;
    }
  EXPECT_EQ(found["ELSET"].size(), names.size() + 1);     // and Eall
  EXPECT_EQ(found["NSET"].size(), 2 * names.size() + 1);  // and Nall
  EXPECT_EQ(found["NAME"].size(), names.size());
  EXPECT_NE(text.find("** tissue 2: M\u00fcller/Gro\u00df\n"), std::string::npos);
}

}  // namespace
}  // namespace sinew
