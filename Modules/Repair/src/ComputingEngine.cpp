#include "ComputingEngine.h"

#include "Binding.h"
#include "sinew/LevelSet/Csg.h"
#include "sinew/LevelSet/LevelSetFromLabels.h"
#include "sinew/LevelSet/LevelSetFromTriangles.h"
#include "sinew/LevelSet/Redistance.h"
#include "sinew/LevelSet/ResampleLevelSet.h"
#include "sinew/LevelSet/ShapeParts.h"
#include "sinew/LevelSet/Smooth.h"

#include <algorithm>
#include <cmath>

namespace sinew::repair {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

/// Half width of the band, samples; wider where a fillet asks for it.
constexpr double kBandSamples = 4;
/// So far outside of what is needed, beyond the band, a solid is cut off, samples.
constexpr double kUnseenSamples = 3;

AlignedBox3d grown(const AlignedBox3d& box, double margin) {
  return {box.min().array() - margin, box.max().array() + margin};
}

/// LPS box of the samples.
AlignedBox3d sampleBox(const DenseLevelSet& levelSet) {
  const Vector3d last = (levelSet.phi.size - Vector3i::Ones()).cast<double>();
  return AlignedBox3d(Vector3d::Zero(), levelSet.voxelSize * last)
      .transformed(Eigen::Affine3d(levelSet.frame));
}

DenseLevelSet withWiderBand(const DenseLevelSet& levelSet, double band) {
  const int layers = 1 + static_cast<int>(std::ceil((band - levelSet.band) / levelSet.voxelSize));
  const Vector3i margin = Vector3i::Constant(layers);
  DenseLevelSet wide = onBox(levelSet, -margin, levelSet.phi.size + margin - Vector3i::Ones());
  wide.band = band;
  redistance(wide);
  return wide;
}

DenseLevelSet combinedLevelSets(Csg operation, const DenseLevelSet& a, const DenseLevelSet& b, double blend) {
  if (operation == Csg::Union) return unite(a, b, blend);
  return operation == Csg::Difference ? subtract(a, b, blend) : intersect(a, b, blend);
}

}  // namespace

ComputingEngine::ComputingEngine(const Segmentation& input, const RepairOptions& options)
    : ShapeEngine(input),
      lattice_(commonLattice(input.geometry, options.gridSpacing)),
      smoothingVoxels_(options.smoothingVoxels),
      smoothingTime_(options.smoothingTime),
      band_(kBandSamples * lattice_.spacing),
      limit_(options.limits.shapeBytes),
      tissues_(input.tissues.size()),
      tissueSummaries_(input.tissues.size()),
      image_(physicalBox(input.geometry, {Vector3i::Zero(), input.geometry.size})) {}

// Room.

void ComputingEngine::makeRoom(double bytes) {
  const auto fits = [&] { return bytes <= static_cast<double>(limit_ - *held_); };
  if (fits()) return;
  if (collect_) collect_();
  if (fits()) return;
  for (LevelSetPtr& tissue : tissues_)  // they can be made again
    if (tissue.use_count() == 1) tissue.reset();
  if (!fits())
    throw ScriptError("the shapes of the script take more than " + std::to_string(limit_ / 1'000'000) +
                      " MB; make them smaller, or --grid larger");
}

void ComputingEngine::makeRoomFor(const AlignedBox3d& box) {
  const Vector3d sides = box.transformed(Eigen::Affine3d(lattice_.frame.inverse())).sizes().cwiseMax(0);
  const Vector3d samples = sides.array() / lattice_.spacing + 2 * (kBandSamples + 1);
  makeRoom(static_cast<double>(sizeof(float)) * samples.prod());
}

LevelSetPtr ComputingEngine::held(DenseLevelSet levelSet) {
  const auto bytes = static_cast<std::int64_t>(levelSet.phi.values.size() * sizeof(float));
  makeRoom(static_cast<double>(bytes));
  *held_ += bytes;
  const auto release = [count = held_, bytes](const DenseLevelSet* gone) {
    *count -= bytes;
    delete gone;
  };
  return {new DenseLevelSet(std::move(levelSet)), release};
}

ShapePtr ComputingEngine::made(Shape shape, DenseLevelSet levelSet, bool distance) {
  shape.box = sampleBox(levelSet);
  shape.levelSet = held(std::move(levelSet));
  shape.distance = distance;
  return std::make_shared<const Shape>(std::move(shape));
}

// Level sets.

LevelSetPtr ComputingEngine::tissueLevelSet(int index) {
  const auto t = static_cast<std::size_t>(index);
  if (!tissues_[t]) {
    makeRoomFor(physicalBox(input_.geometry, input_.tissues[t].box));
    LevelSetFromLabelsOptions options;
    options.smoothingVoxels = smoothingVoxels_;
    options.bandVoxels = kBandSamples;
    options.gridSpacing = lattice_.spacing;
    options.onCommonLattice = true;
    options.preserveTopology = smoothingVoxels_ > 0;
    DenseLevelSet levelSet = denseLevelSetFromLabels(input_, input_.tissues[t], options);
    if (smoothingTime_ > 0) smooth(levelSet, {.time = smoothingTime_});
    tissues_[t] = held(std::move(levelSet));
  }
  return tissues_[t];
}

AlignedBox3d ComputingEngine::finiteBox(const ShapePtr& shape, const ShapePtr& other) const {
  if (isFinite(shape->box)) return shape->box;
  return other && isFinite(other->box) ? image_.merged(other->box) : image_;
}

LevelSetPtr ComputingEngine::sampled(const ShapePtr& shape, const AlignedBox3d& within, double band) {
  band = std::max(band, band_);
  if (shape->solid) {
    const AlignedBox3d seen = grown(within, band + kUnseenSamples * lattice_.spacing);
    const AlignedBox3d part = shape->solid->bounds.intersection(seen);
    makeRoomFor(grown(part, band - band_));
    return held(sampleSolid(*shape->solid, lattice_, band, seen));
  }
  const LevelSetPtr levelSet = shape->untouched ? tissueLevelSet(shape->origin) : shape->levelSet;
  if (levelSet->band >= band) return levelSet;
  makeRoomFor(grown(sampleBox(*levelSet), band - levelSet->band));
  return held(withWiderBand(*levelSet, band));
}

LevelSetPtr ComputingEngine::levelSetOf(const ShapePtr& shape) {
  return sampled(shape, finiteBox(shape), band_);
}

LevelSetPtr ComputingEngine::distanceOf(const ShapePtr& shape) {
  const LevelSetPtr levelSet = levelSetOf(shape);
  if (shape->solid || shape->distance) return levelSet;
  DenseLevelSet distance = *levelSet;
  redistance(distance);
  return held(std::move(distance));
}

// Operations.

ShapePtr ComputingEngine::mesh(const TriangleMesh& mesh) {
  AlignedBox3d box;
  for (const Vector3d& node : mesh.nodes) box.extend(node);
  makeRoomFor(box);
  return made({}, levelSetFromTriangles({mesh.nodes, mesh.triangles}, lattice_, band_), true);
}

ShapePtr ComputingEngine::combined(Csg operation, const ShapePtr& a, const ShapePtr& b, double blend) {
  AlignedBox3d boxA = finiteBox(a, b), boxB = finiteBox(b, a);
  if (operation == Csg::Union) makeRoomFor(boxA.merged(boxB));
  if (operation == Csg::Intersection) boxA = boxA.intersection(boxB);
  if (operation != Csg::Union) boxB = boxB.intersection(boxA);
  const LevelSetPtr levelSetA = sampled(a, boxA, blend), levelSetB = sampled(b, boxB, blend);
  return made(descendant(a, b), trimmed(combinedLevelSets(operation, *levelSetA, *levelSetB, blend)), false);
}

ShapePtr ComputingEngine::changed(const ShapePtr& shape, const Change& change) {
  const LevelSetPtr before = change.needsDistance ? distanceOf(shape) : levelSetOf(shape);
  makeRoomFor(grown(sampleBox(*before), change.growth));
  return made(descendant(shape), trimmed(change.apply(*before)), change.needsDistance || shape->distance);
}

std::vector<ShapePtr> ComputingEngine::components(const ShapePtr& shape) {
  std::vector<ShapePtr> pieces;
  for (DenseLevelSet& piece : shapeComponents(*levelSetOf(shape)))
    pieces.push_back(made(descendant(shape), std::move(piece), shape->distance));
  return pieces;
}

ShapePtr ComputingEngine::moved(const ShapePtr& shape, const Eigen::Affine3d& motion) {
  if (shape->solid) return solid(sinew::moved(*shape->solid, motion), shape->blend);
  makeRoomFor(finiteBox(shape).transformed(motion));
  Shape result;
  result.name = shape->name;
  return made(std::move(result), trimmed(resampled(*distanceOf(shape), lattice_, band_, motion)), true);
}

// Measures.

std::optional<ShapeSummary> ComputingEngine::summary(const ShapePtr& shape) {
  if (shape->solid || (shape->untouched && !tissues_[static_cast<std::size_t>(shape->origin)]))
    return std::nullopt;
  std::optional<ShapeSummary>& known =
      shape->untouched ? tissueSummaries_[static_cast<std::size_t>(shape->origin)] : shape->summary;
  if (!known) {
    const LevelSetPtr levelSet = levelSetOf(shape);
    known = ShapeSummary{shapeVolume(*levelSet), shapeTopology(*levelSet)};
  }
  return known;
}

double ComputingEngine::volume(const ShapePtr& shape) {
  if (!shape->solid || isFinite(shape->box)) return shapeVolume(*levelSetOf(shape));
  return std::numeric_limits<double>::infinity();
}

AlignedBox3d ComputingEngine::bounds(const ShapePtr& shape) {
  return shape->solid ? shape->solid->bounds : shapeBounds(*levelSetOf(shape));
}

Vector3d ComputingEngine::centroid(const ShapePtr& shape) {
  if (!isFinite(shape->box)) return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  return shapeCentroid(*levelSetOf(shape));
}

}  // namespace sinew::repair
