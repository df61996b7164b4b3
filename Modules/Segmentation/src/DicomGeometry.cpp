#include "DicomGeometry.h"

#include "ImageFormats.h"
#include "Text.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace sinew::dicom {

namespace {

namespace fs = std::filesystem;

constexpr double kSamePlace = 0.01;    // of a pixel; positions are decimal numbers of 16 characters
constexpr double kUnevenGap = 0.05;    // of a spacing: beyond that, slices are not evenly spaced
constexpr double kLargestShift = 0.1;  // of a pixel, within a slice

void requirePlaces(const fs::path& file, const File& dicom) {
  for (std::size_t n = 0; n < dicom.frames.size(); ++n) {
    const Frame& frame = dicom.frames[n];
    const char* missing = !frame.position       ? "ImagePositionPatient"
                          : !frame.axes         ? "ImageOrientationPatient"
                          : !frame.pixelSpacing ? "PixelSpacing"
                                                : nullptr;
    if (missing)
      text::refuse(file, "frame " + std::to_string(n + 1) + " has no " + missing +
                             ", so nobody knows where it lies; export the segmentation again");
    const Frame& first = dicom.frames.front();
    constexpr double sameAxes = 1e-4;  // sine of the angle
    for (int axis = 0; axis < 2; ++axis)
      if (((*frame.axes)[axis] - (*first.axes)[axis]).norm() > sameAxes ||
          std::abs((*frame.pixelSpacing)[axis] - (*first.pixelSpacing)[axis]) >
              kSamePlace * (*first.pixelSpacing)[axis])
        text::refuse(file,
                     "frame " + std::to_string(n + 1) +
                         " has another orientation or pixel size than the first; split the segmentation by "
                         "series");
  }
}

/// Heights along the normal, ascending, without repetition.
std::vector<double> planes(std::vector<double> heights, double tolerance) {
  std::ranges::sort(heights);
  std::vector<double> result;
  for (const double height : heights)
    if (result.empty() || height - result.back() > tolerance) result.push_back(height);
  return result;
}

/// Whether all gaps are whole multiples of a spacing.
bool divides(double spacing, const std::vector<double>& planes) {
  for (std::size_t n = 1; n < planes.size(); ++n) {
    const double steps = (planes[n] - planes[n - 1]) / spacing;
    if (!(std::round(steps) >= 1 && std::abs(steps - std::round(steps)) <= kUnevenGap)) return false;
  }
  return true;
}

/// The slices' distance, mm: what the file says if that fits the positions, for slices may be missing; else
/// the smallest distance of two.
double sliceSpacing(const fs::path& file, const Frame& frame, const std::vector<double>& planes) {
  if (planes.size() == 1) {
    const double fallback = (*frame.pixelSpacing)[0];
    return frame.sliceSpacing.value_or(0) > 0 ? *frame.sliceSpacing : fallback;
  }
  double smallest = planes[1] - planes[0];
  for (std::size_t n = 2; n < planes.size(); ++n) smallest = std::min(smallest, planes[n] - planes[n - 1]);
  for (const double spacing : {frame.sliceSpacing.value_or(0), smallest})
    if (spacing > 0 && divides(spacing, planes)) {
      const double range = planes.back() - planes.front();
      return range / std::round(range / spacing);
    }
  text::refuse(file, "its slices are not evenly spaced (gaps from " + text::format(smallest) +
                         " mm); resample it in 3D Slicer and export a segmentation (.seg.nrrd)");
}

/// Few frames may lie far apart, but memory is in proportion to what lies between.
void requireProportion(const fs::path& file, const File& dicom, double slices) {
  constexpr double smallVolume = 1 << 28, mostPerFrame = 64;  // voxels; slices
  const double voxels = slices * static_cast<double>(dicom.framePixels());
  if (voxels <= smallVolume || slices <= mostPerFrame * static_cast<double>(dicom.frames.size())) return;
  text::refuse(file, "its " + std::to_string(dicom.frames.size()) + " frames lie " + text::format(slices) +
                         " slices apart; its positions or SpacingBetweenSlices may be damaged, export the "
                         "segmentation again");
}

/// The step from slice to slice: along the normal, unless the positions say otherwise.
Eigen::Vector3d sliceStep(const std::vector<Eigen::Vector3d>& positions, const std::vector<int>& slice,
                          const Eigen::Vector3d& alongNormal, double pixel) {
  const auto [low, high] = std::ranges::minmax_element(slice);
  if (*low == *high) return alongNormal;
  const Eigen::Vector3d whole = positions[high - slice.begin()] - positions[low - slice.begin()];
  const Eigen::Vector3d step = whole / (*high - *low);
  const Eigen::Vector3d shift = whole - (*high - *low) * alongNormal;
  return shift.norm() <= kLargestShift * pixel ? alongNormal : step;
}

void requireAligned(const fs::path& file, const std::vector<Eigen::Vector3d>& positions, const Stack& stack,
                    double pixel) {
  const Eigen::Affine3d toPhysical = stack.geometry.indexToPhysical();
  for (std::size_t n = 0; n < positions.size(); ++n) {
    const Eigen::Vector3d expected = toPhysical * Eigen::Vector3d(0, 0, stack.slice[n]);
    const Eigen::Vector3d shift = positions[n] - expected;
    const double height = stack.geometry.spacing.z() * (kUnevenGap + kSamePlace);
    if (shift.norm() > kLargestShift * pixel + height)
      text::refuse(file, "frame " + std::to_string(n + 1) + " is shifted by " + text::format(shift.norm()) +
                             " mm against the others; resample it in 3D Slicer and export a segmentation "
                             "(.seg.nrrd)");
  }
}

}  // namespace

Stack stackFrames(const fs::path& file, const File& dicom) {
  requirePlaces(file, dicom);
  const Frame& first = dicom.frames.front();
  const auto& [betweenRows, betweenColumns] = *first.pixelSpacing;
  requireSpacing(file, betweenColumns, 0, "DICOM PixelSpacing");
  requireSpacing(file, betweenRows, 1, "DICOM PixelSpacing");
  const Eigen::Vector3d alongRow = (*first.axes)[0].normalized(), alongColumn = (*first.axes)[1].normalized();
  const Eigen::Vector3d normal = alongRow.cross(alongColumn).normalized();
  Eigen::Matrix3d axes;
  axes << alongRow, alongColumn, normal;
  requireDirections(file, axes, "DICOM ImageOrientationPatient");
  const double pixel = std::min(std::abs(betweenRows), std::abs(betweenColumns));

  std::vector<Eigen::Vector3d> positions;
  std::vector<double> heights;
  for (const Frame& frame : dicom.frames) {
    positions.push_back(*frame.position);
    heights.push_back(normal.dot(*frame.position));
  }
  const std::vector<double> levels = planes(heights, kSamePlace * pixel);
  const double spacing = sliceSpacing(file, first, levels);
  const double steps = std::round((levels.back() - levels.front()) / spacing);
  requireProportion(file, dicom, steps + 1);

  Stack stack;
  for (const double height : heights)
    stack.slice.push_back(static_cast<int>(std::lround((height - levels.front()) / spacing)));
  const Eigen::Vector3d step = sliceStep(positions, stack.slice, spacing * normal, pixel);
  axes.col(2) = step.normalized();
  stack.geometry = {.size = {dicom.columns, dicom.rows, static_cast<int>(steps) + 1},
                    .spacing = {betweenColumns, betweenRows, step.norm()},
                    .origin = positions[std::ranges::find(stack.slice, 0) - stack.slice.begin()],
                    .direction = axes};
  requireOrigin(file, stack.geometry.origin);
  requireAligned(file, positions, stack, pixel);
  return stack;
}

}  // namespace sinew::dicom
