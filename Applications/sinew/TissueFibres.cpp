#include "TissueFibres.h"

#include "TextTable.h"
#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/ReadMesh.h"
#include "sinew/MeshIO/RegionMesh.h"
#include "sinew/Simulation/BsplineSolidFile.h"
#include "sinew/Simulation/FibreField.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace sinew {
namespace {

using Eigen::Vector3d;
using Nodes = std::vector<std::int32_t>;

constexpr std::string_view kBox = "box:";

/// `box:X,Y,Z,X,Y,Z`, two opposite corners.
Eigen::AlignedBox3d parsedBox(const std::string& where) {
  std::vector<double> numbers;
  for (const std::string& part : CLI::detail::split(where.substr(kBox.size()), ',')) {
    numbers.emplace_back();
    if (!CLI::detail::lexical_cast(part, numbers.back())) numbers.clear();
  }
  if (numbers.size() != 6) throw std::invalid_argument("a box is box:X,Y,Z,X,Y,Z, two corners in mm");
  const Vector3d a(numbers[0], numbers[1], numbers[2]), b(numbers[3], numbers[4], numbers[5]);
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

/// The nodes where the tissue touches what a person names.
Nodes attachment(const TissueMeshInput& input, const std::string& where,
                 const std::optional<double>& contact) {
  const TetMesh& mesh = input.tissue.mesh;
  if (where.starts_with(kBox)) return nodesIn(mesh, parsedBox(where));
  if (findMeshFormat(where) != nullptr) return contactNodes(mesh, readMesh(where).mesh, contact);
  const std::optional<std::int32_t> label = findTissue(input.all, where);
  if (!label) throw std::invalid_argument("neither a mesh file, a tissue of this mesh, nor a box");
  return contactNodes(mesh, regionMesh(input.all, *label).mesh, contact);
}

Vector3d middleOf(const TetMesh& mesh, const Nodes& nodes) {
  Vector3d sum = Vector3d::Zero();
  for (const std::int32_t node : nodes) sum += mesh.nodes[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

/// The end that lies farther from the given nodes.
Nodes fartherEnd(const TetMesh& mesh, const Attachments& ends, const Nodes& from) {
  const Vector3d middle = middleOf(mesh, from);
  const auto distance = [&](const Nodes& nodes) { return (middleOf(mesh, nodes) - middle).norm(); };
  return distance(ends.origin) > distance(ends.insertion) ? ends.origin : ends.insertion;
}

const MeshArray* findArray(const TissueMesh& mesh, const std::string& name, int components) {
  const auto found = std::ranges::find_if(mesh.arrays.cells, [&](const MeshArray& array) {
    return array.name == name && array.components == components;
  });
  return found == mesh.arrays.cells.end() ? nullptr : &*found;
}

NodeVectors vectorsOf(const MeshArray& array) {
  NodeVectors vectors;
  for (std::size_t i = 0; i < array.values.size(); i += 3)
    vectors.emplace_back(array.values[i], array.values[i + 1], array.values[i + 2]);
  return vectors;
}

std::vector<double> tendonsOf(const TissueMeshInput& input, const Attachments& attachments,
                              const std::optional<double>& share) {
  if (share)
    return *share == kLeastTendon ? std::vector<double>{}
                                  : tendonShares(input.tissue.mesh, attachments, *share);
  const MeshArray* own = findArray(input.tissue, "tendon", 1);
  if (own == nullptr) return {};
  return {own->values.begin(), own->values.end()};
}

/// What `compute` returns; its complaints get the name of the file.
template <class Compute>
auto naming(const std::string& file, const Compute& compute) {
  try {
    return compute();
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

void checkShareOf(const char* option, double share, double least) {
  try {
    checkShare(share, least);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(option, error.what());
  }
}

void takeSpline(const TissueMeshInput& input, const std::string& file, TissueFibres& fibres) {
  const TetMesh& mesh = input.tissue.mesh;
  SplineFibres spline = splineFibres(mesh, readBsplineSolid(file));
  const double far = meanBoundaryEdge(mesh);
  fibres.outside = std::ranges::count_if(spline.distances, [&](double distance) { return distance > far; });
  if (fibres.outside == std::ssize(mesh.tets))
    throw std::runtime_error(
        input.file + ": --spline " + file +
        ": all tets lie outside of the solid; are its points in mm, and its space right?");
  fibres.directions = filledFibres(mesh, std::move(spline.directions));
  fibres.source = "spline";
}

void takeArray(const TissueMeshInput& input, const MeshArray& array, TissueFibres& fibres) {
  fibres.directions = naming(input.file, [&] { return filledFibres(input.tissue.mesh, vectorsOf(array)); });
  fibres.source = "mesh";
}

void takeField(const TissueMeshInput& input, const Attachments& attachments, TissueFibres& fibres) {
  fibres.directions = naming(input.file, [&] { return fibreField(input.tissue.mesh, attachments); });
  fibres.source = "harmonic";
}

}  // namespace

void checkFibreSettings(const FibreSettings& settings) {
  checkShareOf("--ends", settings.ends, kLeastEnd);
  if (settings.tendon) checkShareOf("--tendon", *settings.tendon, kLeastTendon);
}

std::string TissueFibres::warning() const {
  constexpr std::int64_t kMany = 10;  // one in
  if (kMany * outside > std::ssize(directions))
    return grouped(outside) + " of " + grouped(std::ssize(directions)) +
           " tets lie outside of the spline; its nearest points tell their fibres";
  if (missing > 0)
    return grouped(missing) + " of " + grouped(std::ssize(directions)) +
           " tets have no fibre: their pieces of the mesh reach one of the ends at most";
  return {};
}

std::vector<Option> fibreOptions(FibreSettings& settings) {
  constexpr const char* kWhere =
      "; a neighbour's mesh file, a tissue of the same mesh, or box:X,Y,Z,X,Y,Z in mm (LPS)";
  return {
      {"--label", &settings.tissue, "the tissue, where the mesh holds several", "NAME|LABEL"},
      {"--origin", &settings.origin,
       std::string("what the muscle comes from") + kWhere + "; default the end towards the head", "WHERE"},
      {"--insertion", &settings.insertion,
       std::string("what it goes to") + kWhere + "; default the other end", "WHERE"},
      {.flags = "--ends",
       .target = &settings.ends,
       .help = "share of the length that each end takes along the longest axis, below 0.5",
       .form = "SHARE"},
      {.flags = "--contact",
       .target = &settings.contact,
       .help = "how near a neighbour touches, mm; default the mean edge of the mesh's boundary",
       .form = "MM",
       .least = 0},
      {"--tendon", &settings.tendon,
       "share of the length that is tendon at each end, below 0.5; it fades over half as much again; default "
       "none",
       "SHARE"},
      {"--spline", &settings.spline,
       "control points of a B-spline solid along whose third direction fibres run", "FILE"},
  };
}

Attachments attachmentsOf(const TissueMeshInput& input, const FibreSettings& settings) {
  const auto named = [&](const char* option, const std::string& where) -> Nodes {
    if (where.empty()) return {};
    return naming(input.file + ": " + option + " " + where,
                  [&] { return attachment(input, where, settings.contact); });
  };
  Attachments chosen{named("--origin", settings.origin), named("--insertion", settings.insertion)};
  return naming(input.file, [&] {
    if (chosen.origin.empty() || chosen.insertion.empty()) {
      const Attachments ends = naming("--ends", [&] { return endsOf(input.tissue.mesh, settings.ends); });
      const bool neither = chosen.origin.empty() && chosen.insertion.empty();
      if (neither)
        chosen = ends;
      else if (chosen.origin.empty())
        chosen.origin = fartherEnd(input.tissue.mesh, ends, chosen.insertion);
      else
        chosen.insertion = fartherEnd(input.tissue.mesh, ends, chosen.origin);
    }
    checkApart(chosen);
    return chosen;
  });
}

TissueFibres fibresOf(const TissueMeshInput& input, const Attachments& attachments,
                      const FibreSettings& settings, OwnFibres own) {
  const bool take = own == OwnFibres::Take && settings.spline.empty();
  const MeshArray* array = take ? findArray(input.tissue, "fibres", 3) : nullptr;
  TissueFibres fibres;
  if (!settings.spline.empty())
    takeSpline(input, settings.spline, fibres);
  else if (array != nullptr)
    takeArray(input, *array, fibres);
  else
    takeField(input, attachments, fibres);
  fibres.tendons = tendonsOf(input, attachments, settings.tendon);
  fibres.missing =
      std::ranges::count_if(fibres.directions, [](const Vector3d& fibre) { return fibre.isZero(); });
  if (fibres.missing == std::ssize(fibres.directions))
    throw std::runtime_error(
        input.file + ": no tet gets a fibre: " +
        (array != nullptr
             ? "the mesh's array fibres is zero everywhere; make it anew with sinew fibres"
             : "no piece of the mesh reaches from the origin to the insertion; choose both on its "
               "largest piece, with --origin and --insertion"));
  return fibres;
}

MeshArray vectorArray(const std::string& name, const NodeVectors& vectors) {
  MeshArray array{name, {}, 3};
  for (const Vector3d& vector : vectors)
    for (const double component : vector) array.values.push_back(static_cast<float>(component));
  return array;
}

}  // namespace sinew
