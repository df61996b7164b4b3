// Meshes one tissue of a segmentation with CGAL's labelled-image Mesh_3, as CGAL's example mesh_3D_image.cpp
// does: the peer of `sinew mesh` in the comparison. Reads and writes with Sinew's own modules, so that both
// programs pay the same for their files.
#include "sinew/MeshIO/WriteMesh.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/SelectTissues.h"

#include <CLI/CLI.hpp>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>
#include <iostream>
#include <unordered_map>

namespace sinew {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace parameters = CGAL::parameters;

struct Options {
  std::string input, tissue, output;
  double cellSize = 0;  ///< CGAL's cell_size, mm
  // The other criteria as in the example, which has facet_size 6, facet_distance 4 and cell_size 8.
  double facetSize = 0.75;     ///< in cell sizes
  double facetDistance = 0.5;  ///< in cell sizes
  double radiusEdgeRatio = 3;
  bool withoutExude = false, withoutPerturb = false, readOnly = false;
};

constexpr int kMargin = 2;  // voxels of background around the tissue, as CGAL asks for

/// The voxels of a tissue, 1 in 0, with their spacing; voxel (0,0,0) of the crop is `box.lower`.
CGAL::Image_3 cropImage(const Segmentation& segmentation, const Tissue& tissue, const VoxelBox& box) {
  const Eigen::Vector3i size = box.upper - box.lower;
  const Eigen::Vector3d& spacing = segmentation.geometry.spacing;
  _image* image = _createImage(size.x(), size.y(), size.z(), 1, spacing.x(), spacing.y(), spacing.z(), 1,
                               WK_FIXED, SGN_UNSIGNED);
  auto* voxel = static_cast<unsigned char*>(image->data);
  const VoxelBox& inner = tissue.box;
  for (int z = box.lower.z(); z < box.upper.z(); ++z)
    for (int y = box.lower.y(); y < box.upper.y(); ++y)
      for (int x = box.lower.x(); x < box.upper.x(); ++x) {
        const Eigen::Array3i index(x, y, z);
        const bool inside = (index >= inner.lower.array()).all() && (index < inner.upper.array()).all();
        *voxel++ = inside && segmentation.at(tissue.layer, index.matrix()) == tissue.label;
      }
  return CGAL::Image_3(image);
}

Criteria criteria(const Options& options) {
  return Criteria(parameters::facet_angle = 30, parameters::facet_size = options.facetSize * options.cellSize,
                  parameters::facet_distance = options.facetDistance * options.cellSize,
                  parameters::cell_radius_edge_ratio = options.radiusEdgeRatio,
                  parameters::cell_size = options.cellSize);
}

Complex meshImage(const CGAL::Image_3& image, const Options& options) {
  const Domain domain = Domain::create_labeled_image_mesh_domain(image);
  return CGAL::make_mesh_3<Complex>(domain, criteria(options),
                                    options.withoutPerturb ? parameters::no_perturb() : parameters::perturb(),
                                    options.withoutExude ? parameters::no_exude() : parameters::exude());
}

/// @param toPhysical  CGAL's coordinates to LPS mm; may reflect
TetMesh toTetMesh(const Complex& complex, const Eigen::Affine3d& toPhysical, std::int32_t label) {
  TetMesh mesh;
  std::unordered_map<Complex::Vertex_handle, std::int32_t> indices;
  const auto indexOf = [&](Complex::Vertex_handle vertex) {
    const auto [place, isNew] = indices.try_emplace(vertex, static_cast<std::int32_t>(mesh.nodes.size()));
    const auto& point = vertex->point();
    if (isNew) mesh.nodes.push_back(toPhysical * Eigen::Vector3d(point.x(), point.y(), point.z()));
    return place->second;
  };
  const bool reflects = toPhysical.linear().determinant() < 0;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    Tet tet;
    for (int v = 0; v < 4; ++v) tet[v] = indexOf(cell->vertex(v));
    if (reflects) std::swap(tet[2], tet[3]);
    mesh.tets.push_back(tet);
  }
  mesh.labels.assign(mesh.tets.size(), label);
  mesh.kinds.assign(mesh.nodes.size(), NodeKind::Interior);  // the writer does not look at them
  return mesh;
}

void run(const Options& options) {
  const Segmentation segmentation = readSegmentation(options.input);
  if (options.readOnly) return;
  const Tissue& tissue = segmentation.tissues[selectTissues(segmentation, {options.tissue}).front()];
  const VoxelBox box{tissue.box.lower.array() - kMargin, tissue.box.upper.array() + kMargin};
  const Complex complex = meshImage(cropImage(segmentation, tissue, box), options);

  const ImageGeometry& geometry = segmentation.geometry;
  const Eigen::Affine3d toPhysical = geometry.indexToPhysical() *
                                     Eigen::Translation3d(box.lower.cast<double>()) *
                                     Eigen::Scaling(geometry.spacing.cwiseInverse().eval());
  const TissueMesh mesh{
      toTetMesh(complex, toPhysical, tissue.label), {{tissue.label, tissue.name, tissue.color}}, {}};
  writeMesh(mesh, options.output);
  std::cout << "{\"tets\": " << mesh.mesh.tets.size() << "}\n";
}

}  // namespace
}  // namespace sinew

int main(int argc, char** argv) {
  sinew::Options options;
  CLI::App app("Meshes one tissue of a segmentation with CGAL's Mesh_3.");
  app.add_option("INPUT", options.input, "segmentation")->required();
  app.add_option("TISSUE", options.tissue, "name or label")->required();
  app.add_option("SIZE", options.cellSize, "CGAL's cell_size, mm; the other criteria follow it")->required();
  app.add_option("OUTPUT", options.output, "mesh to write: .vtu")->required();
  app.add_option("--facet-size", options.facetSize, "facet_size, in cell sizes")->capture_default_str();
  app.add_option("--facet-distance", options.facetDistance, "facet_distance, in cell sizes")
      ->capture_default_str();
  app.add_option("--radius-edge-ratio", options.radiusEdgeRatio, "cell_radius_edge_ratio")
      ->capture_default_str();
  app.add_flag("--no-exude", options.withoutExude, "leave out the sliver exudation");
  app.add_flag("--no-perturb", options.withoutPerturb, "leave out the sliver perturbation");
  app.add_flag("--read-only", options.readOnly, "read the segmentation and stop");
  CLI11_PARSE(app, argc, argv);
  try {
    sinew::run(options);
  } catch (const std::exception& error) {
    std::cerr << "cgalMesh3: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
