#include "sinew/MeshIO/QuadraticMesh.h"

#include "TetEdges.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace sinew {
namespace {

/// The place among the 20 coefficients of every product of three linear Bezier polynomials, i j k.
struct CubicTable {
  std::array<int, 64> place{};
  std::array<int, 20> products{};  ///< that share a place
};

constexpr CubicTable makeCubicTable() {
  CubicTable table;
  int next = 0;
  std::array<int, 64> placeOfSorted{};
  for (int i = 0; i < 4; ++i)
    for (int j = i; j < 4; ++j)
      for (int k = j; k < 4; ++k) placeOfSorted[16 * i + 4 * j + k] = next++;
  for (int product = 0; product < 64; ++product) {
    std::array<int, 3> index{product / 16, product / 4 % 4, product % 4};
    std::sort(index.begin(), index.end());
    table.place[product] = placeOfSorted[16 * index[0] + 4 * index[1] + index[2]];
    ++table.products[table.place[product]];
  }
  return table;
}
constexpr CubicTable kCubic = makeCubicTable();

}  // namespace

std::array<double, 20> jacobianCoefficients(const std::array<Eigen::Vector3d, 10>& nodes) {
  // x = sum_ij b_ij l_i l_j with the control points b_ii = x_i and b_ij = 2 m_ij - (x_i + x_j) / 2
  std::array<std::array<Eigen::Vector3d, 4>, 4> control;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      control[i][j] = i == j ? nodes[i] : (2 * nodes[kMiddleOf[i][j]] - (nodes[i] + nodes[j]) / 2).eval();
  // dx/dr_k = sum_i 2 (b_ik - b_i0) l_i
  std::array<std::array<Eigen::Vector3d, 4>, 4> derivative;
  for (int i = 0; i < 4; ++i)
    for (int k = 1; k < 4; ++k) derivative[k][i] = 2 * (control[i][k] - control[i][0]);

  std::array<double, 20> coefficients{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const Eigen::Vector3d normal = derivative[1][i].cross(derivative[2][j]);
      for (int k = 0; k < 4; ++k) {
        const int place = kCubic.place[16 * i + 4 * j + k];
        coefficients[place] += normal.dot(derivative[3][k]) / kCubic.products[place];
      }
    }
  return coefficients;
}

QuadraticMesh quadraticMesh(const TetMesh& mesh, const std::vector<CurvedEdge>& curved) {
  const TetEdges edges(mesh);
  QuadraticMesh quadratic;
  quadratic.nodes.reserve(mesh.nodes.size() + edges.size());
  quadratic.nodes = mesh.nodes;
  edges.forEach([&](std::int32_t a, std::int32_t b) {
    quadratic.nodes.push_back((mesh.nodes[a] + mesh.nodes[b]) / 2);
  });
  const std::size_t corners = mesh.nodes.size();
  for (const CurvedEdge& edge : curved)
    quadratic.nodes[corners + edges.find(edge.nodes[0], edge.nodes[1])] = edge.middle;

  quadratic.tets.reserve(mesh.tets.size());
  for (const Tet& tet : mesh.tets) {
    QuadraticTet& added = quadratic.tets.emplace_back();
    std::ranges::copy(tet, added.begin());
    for (int e = 0; e < 6; ++e)
      added[4 + e] =
          static_cast<std::int32_t>(corners + edges.find(tet[kMiddles[e][0]], tet[kMiddles[e][1]]));
  }
  return quadratic;
}

}  // namespace sinew
