#include "sinew/LevelSet/VdbFile.h"

#include "GridTransform.h"
#include "sinew/LevelSet/LevelSetGrid.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/File.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/Stream.h>

#include <cmath>
#include <fstream>
#include <stdexcept>

namespace sinew {
namespace {

namespace fs = std::filesystem;
using openvdb::FloatGrid;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

/// What OpenVDB complains about, on one line.
std::string lineOf(const std::exception& error) {
  const std::string text = error.what();
  return text.substr(0, text.find('\n'));
}

/// The first level set of the grids, or null.
FloatGrid::Ptr firstLevelSet(const openvdb::GridPtrVec& grids) {
  for (const openvdb::GridBase::Ptr& grid : grids)
    if (grid->isType<FloatGrid>() && grid->getGridClass() == openvdb::GRID_LEVEL_SET)
      return openvdb::gridPtrCast<FloatGrid>(grid);
  return nullptr;
}

/// The table of contents of a file.
class Contents : openvdb::io::Archive {
 public:
  /// Whether all grids end inside of the file; a file without places of its grids is taken as whole.
  bool areWhole(std::istream& in, std::streamoff fileSize) {
    readHeader(in);
    openvdb::io::setVersion(in, libraryVersion(), fileVersion());
    if (!inputHasGridOffsets()) return true;
    openvdb::MetaMap().readMeta(in);
    const std::int32_t grids = readGridCount(in);
    for (std::int32_t g = 0; g < grids; ++g) {
      openvdb::io::GridDescriptor grid;
      grid.read(in);
      if (grid.getEndPos() < in.tellg() || grid.getEndPos() > fileSize) return false;
      grid.seekToEnd(in);
    }
    return true;
  }
};

/// OpenVDB's errors, and those of the standard library on sizes that a damaged file claims, as ours. OpenVDB
/// does not look whether a read succeeded, so the stream throws at the file's end; that leaks the tree being
/// read, so files that end too early are told by their contents first.
FloatGrid::Ptr readGrid(const fs::path& file) try {
  constexpr bool kDelayed = false;  // a file that changes later must not change the grid
  std::ifstream in(file, std::ios::binary);
  in.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
  if (!Contents().areWhole(in, static_cast<std::streamoff>(fs::file_size(file))))
    throw std::runtime_error("it ends too early");
  in.seekg(0);
  return firstLevelSet(*openvdb::io::Stream(in, kDelayed).getGrids());
} catch (const std::exception& error) {
  fail(file, "damaged or no OpenVDB file (" + lineOf(error) + ")");
}

bool holdsDistances(const FloatGrid& grid) {
  if (!(grid.background() > 0) || !std::isfinite(grid.background())) return false;
  for (auto value = grid.cbeginValueAll(); value; ++value)
    if (!std::isfinite(*value)) return false;
  return true;
}

/// One sample around the active ones.
openvdb::CoordBBox sampleBox(const FloatGrid& grid, const fs::path& file) {
  constexpr double kMostSamples = 2147483648.0, kFarthest = 1e9;
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) fail(file, "its level set has no surface");
  double samples = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.min()[axis], high = box.max()[axis];
    samples *= high - low + 3;
    if (std::max(std::abs(low), std::abs(high)) > kFarthest) samples = 2 * kMostSamples;
  }
  if (samples > kMostSamples) fail(file, "the box of its level set has more than 2^31 samples");
  return {box.min().offsetBy(-1), box.max().offsetBy(1)};
}

}  // namespace

void writeVdb(const LevelSet& levelSet, const std::string& name, const fs::path& file) {
  openvdb::initialize();
  const FloatGrid::Ptr grid = levelSet.grid->grid->copy();  // shares the tree
  grid->setName(name);
  try {
    openvdb::io::File out(file.string());
    out.write(openvdb::GridCPtrVec{grid});
  } catch (const std::exception& error) {
    fail(file, "cannot be written (" + lineOf(error) + ")");
  }
}

LevelSet readVdb(const fs::path& file) {
  openvdb::initialize();
  if (!fs::exists(file)) fail(file, "no such file");
  if (!fs::is_regular_file(file) || !std::ifstream(file)) fail(file, "cannot be read");
  const FloatGrid::Ptr grid = readGrid(file);
  if (!grid) fail(file, "has no level set: a float grid of class \"level set\"");
  const auto place = gridFrame(grid->transform());
  if (!place) fail(file, "the samples of its level set are stretched, sheared or mirrored");
  if (!holdsDistances(*grid)) fail(file, "damaged: its level set holds values that are no distances");
  const openvdb::CoordBBox box = sampleBox(*grid, file);

  LevelSet result;
  result.grid = std::make_shared<LevelSetGrid>(LevelSetGrid{grid});
  result.frame = place->frame;
  result.voxelSize = place->voxelSize;
  result.band = grid->background();
  result.lower = {box.min().x(), box.min().y(), box.min().z()};
  result.upper = {box.max().x(), box.max().y(), box.max().z()};
  return result;
}

}  // namespace sinew
