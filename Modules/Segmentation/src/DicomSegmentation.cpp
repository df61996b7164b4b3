#include "DicomSegmentation.h"

#include "DicomFile.h"
#include "DicomGeometry.h"
#include "Terminology.h"
#include "Text.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>

namespace sinew {

namespace {

namespace fs = std::filesystem;
using dicom::File;
using dicom::Kind;

/// Calls `visit(pixel)` for every pixel of a frame that belongs to its segment.
template <class Visit>
void forPixels(const File& file, std::size_t frame, int leastValue, Visit visit) {
  const std::size_t count = file.framePixels(), first = frame * count;
  if (file.kind == Kind::Fractional) {
    for (std::size_t pixel = 0; pixel < count; ++pixel)
      if (file.pixels[first + pixel] >= leastValue) visit(pixel);
    return;
  }
  for (std::size_t pixel = 0; pixel < count; ++pixel) {
    const std::size_t bit = first + pixel;
    const std::uint8_t byte = file.pixels[bit / 8];
    if (byte == 0 && bit % 8 == 0)
      pixel += 7;  // most of a frame is background
    else if (byte >> (bit % 8) & 1)
      visit(pixel);
  }
}

/// The least value that reaches a share of the maximum, at least 1.
int leastValue(double share, int maximum) {
  return std::max(1, static_cast<int>(std::ceil(share * maximum - 1e-9 * maximum)));
}

/// Puts segments into layers: each into the first in which it overlaps no other.
class LayerPainter {
 public:
  LayerPainter(const File& file, const dicom::Stack& stack, int leastValue)
      : file_(file), stack_(stack), leastValue_(leastValue) {}

  /// @return the layer
  int paint(int segment, const std::vector<std::size_t>& frames) {
    for (std::size_t layer = 0;; ++layer) {
      if (layer == layers_.size())
        layers_.emplace_back(static_cast<std::size_t>(stack_.geometry.voxelCount()), 0);
      if (!isFree(layers_[layer], frames)) continue;
      for (const std::size_t frame : frames) {
        std::int32_t* slice = layers_[layer].data() + offset(frame);
        forPixels(file_, frame, leastValue_, [&](std::size_t pixel) { slice[pixel] = segment; });
      }
      return static_cast<int>(layer);
    }
  }

  std::vector<std::vector<std::int32_t>> take() { return std::move(layers_); }

 private:
  std::size_t offset(std::size_t frame) const {
    return static_cast<std::size_t>(stack_.slice[frame]) * file_.framePixels();
  }

  bool isFree(const std::vector<std::int32_t>& layer, const std::vector<std::size_t>& frames) const {
    bool free = true;
    for (const std::size_t frame : frames) {
      const std::int32_t* slice = layer.data() + offset(frame);
      forPixels(file_, frame, leastValue_, [&](std::size_t pixel) { free &= slice[pixel] == 0; });
      if (!free) return false;
    }
    return true;
  }

  const File& file_;
  const dicom::Stack& stack_;
  int leastValue_;
  std::vector<std::vector<std::int32_t>> layers_;
};

/// Frames by the segment that they show.
std::map<int, std::vector<std::size_t>> framesOfSegments(const fs::path& path, const File& file) {
  std::map<int, std::vector<std::size_t>> result;
  for (std::size_t frame = 0; frame < file.frames.size(); ++frame) {
    const auto segment = file.frames[frame].segment;
    if (!segment || *segment == 0)
      text::refuse(path, "frame " + std::to_string(frame + 1) +
                             " does not say which segment it shows (ReferencedSegmentNumber); export the "
                             "segmentation again");
    result[*segment].push_back(frame);
  }
  return result;
}

/// Pixels of a label map are numbers of segments.
std::vector<std::int32_t> labelMap(const File& file, const dicom::Stack& stack, int labelOfZero) {
  const std::size_t count = file.framePixels();
  const int background = file.padding.value_or(0);
  std::vector<std::int32_t> layer(static_cast<std::size_t>(stack.geometry.voxelCount()), 0);
  for (std::size_t frame = 0; frame < file.frames.size(); ++frame) {
    std::int32_t* slice = layer.data() + static_cast<std::size_t>(stack.slice[frame]) * count;
    for (std::size_t pixel = 0, at = frame * count; pixel < count; ++pixel, ++at) {
      const int value = file.bits == 8 ? file.pixels[at] : file.pixels[2 * at] | file.pixels[2 * at + 1] << 8;
      if (value != background) slice[pixel] = value == 0 ? labelOfZero : value;
    }
  }
  return layer;
}

std::string terminologyOf(const dicom::Segment& segment) {
  std::vector<std::string> cells;
  for (const dicom::Code* code :
       {&segment.category, &segment.type, &segment.typeModifier, &segment.region, &segment.regionModifier})
    cells.insert(cells.end(), {code->scheme, code->value, code->meaning});
  return terminology::entry(cells, "Segmentation category and type - DICOM master list",
                            "Anatomic codes - DICOM master list");
}

Tissue tissueOf(const dicom::Segment& segment, int label, int layer, int order) {
  Tissue tissue;
  tissue.id = "Segment_" + std::to_string(segment.number);
  tissue.name = segment.label.empty() ? tissue.id : segment.label;
  tissue.named = !segment.label.empty();
  tissue.layer = layer;
  tissue.label = label;
  tissue.color = segment.color.value_or(labelColor(label));
  tissue.order = order;
  if (const std::string entry = terminologyOf(segment); !entry.empty())
    tissue.tags.emplace(terminology::kTag, entry);
  return tissue;
}

int requireThreshold(const fs::path& path, const File& file, std::optional<double> threshold) {
  if (threshold && !(*threshold > 0 && *threshold <= 1))
    throw std::invalid_argument(
        "the share of a fractional voxel that belongs to the tissue must lie in (0, 1], not " +
        text::format(*threshold));
  if (file.kind != Kind::Fractional) return 1;
  if (!threshold)
    text::refuse(path,
                 "is a FRACTIONAL segmentation: its voxels hold shares, no labels; say from which share on a "
                 "voxel belongs (--fractional-threshold 0.5)");
  return leastValue(*threshold, file.maximumFraction);
}

void warnOfUnknown(Segmentation& segmentation, const std::set<int>& known) {
  std::set<int> unknown;
  for (const Tissue& tissue : segmentation.tissues)
    if (!known.contains(tissue.label)) unknown.insert(tissue.label);
  if (unknown.empty()) return;
  segmentation.warnings.push_back(segmentation.source + ": " + std::to_string(unknown.size()) +
                                  " segments are painted but not described, first number " +
                                  std::to_string(*unknown.begin()));
}

}  // namespace

bool isDicom(const fs::path& file) {
  constexpr std::size_t at = 128;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;
  std::string front(at + 4, '\0');
  std::ifstream(file, std::ios::binary).read(front.data(), static_cast<std::streamsize>(front.size()));
  return front.substr(at) == "DICM";
}

Segmentation readDicomSegmentation(const fs::path& path, std::optional<double> fractionalThreshold) {
  const File file = dicom::readFile(path);
  const int least = requireThreshold(path, file, fractionalThreshold);
  const dicom::Stack stack = dicom::stackFrames(path, file);

  Segmentation segmentation;
  segmentation.geometry = stack.geometry;
  segmentation.source = path.string();
  std::map<int, int> layerOf;
  int labelOfZero = 1;
  for (const dicom::Segment& segment : file.segments) labelOfZero = std::max(labelOfZero, segment.number + 1);
  if (file.kind == Kind::LabelMap) {
    segmentation.layers.push_back(labelMap(file, stack, labelOfZero));
  } else {
    LayerPainter painter(file, stack, least);
    for (const auto& [segment, frames] : framesOfSegments(path, file))
      layerOf[segment] = painter.paint(segment, frames);
    segmentation.layers = painter.take();
  }
  std::set<int> known;
  for (const dicom::Segment& segment : file.segments) {
    const bool isBackground = segment.number < 0 || (segment.number == 0 && file.padding.value_or(0) == 0);
    const int label = segment.number == 0 ? labelOfZero : segment.number;
    if (isBackground || !known.insert(label).second) continue;
    segmentation.tissues.push_back(
        tissueOf(segment, label, layerOf[segment.number], static_cast<int>(segmentation.tissues.size())));
  }
  updateTissueTable(segmentation);
  warnOfUnknown(segmentation, known);
  return segmentation;
}

}  // namespace sinew
