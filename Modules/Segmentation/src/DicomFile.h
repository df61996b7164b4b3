#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// What a DICOM segmentation says, before anyone makes sense of it. The door to DCMTK; no other file knows
/// it.
namespace sinew::dicom {

enum class Kind { Binary, Fractional, LabelMap };

/// An entry of a code sequence; empty when there is none.
struct Code {
  std::string scheme, value, meaning;
};

/// An item of the Segment Sequence.
struct Segment {
  int number = 0;
  std::string label;
  std::optional<std::array<double, 3>> color;  ///< RGB in 0..1
  Code category, type, typeModifier, region, regionModifier;
};

/// What the functional groups say of a frame, be they its own or shared.
struct Frame {
  std::optional<Eigen::Vector3d> position;             ///< centre of the first pixel, LPS mm
  std::optional<std::array<Eigen::Vector3d, 2>> axes;  ///< unit vectors along a row and along a column
  std::optional<std::array<double, 2>> pixelSpacing;   ///< mm: between rows, between columns
  std::optional<double> sliceSpacing;                  ///< mm: SpacingBetweenSlices, or else SliceThickness
  std::optional<int> segment;                          ///< number of the one that it shows
};

struct File {
  Kind kind = Kind::Binary;
  int rows = 0, columns = 0;
  int bits = 1;                ///< per pixel: 1, 8 or 16
  int maximumFraction = 255;   ///< the value that means 1
  std::optional<int> padding;  ///< LABELMAP: the value of pixels outside of everything
  std::vector<Segment> segments;
  std::vector<Frame> frames;
  std::vector<std::uint8_t> pixels;  ///< of all frames without gaps, little endian, bits from the lowest up

  std::size_t framePixels() const { return std::size_t(rows) * std::size_t(columns); }
};

/// Reads a DICOM segmentation: SegmentationStorage, binary or fractional, and Label Map Segmentation Storage;
/// uncompressed, deflated or run-length encoded.
/// @throws std::runtime_error, one line naming the file: another kind of DICOM object, a compression that
/// DCMTK cannot
///         undo, missing or contradicting elements, fewer pixels than promised
File readFile(const std::filesystem::path& file);

}  // namespace sinew::dicom
