#include "ImageHeader.h"

#include "DicomSegmentation.h"
#include "ImageFormats.h"
#include "Text.h"
#include "UnpackStream.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <span>
#include <string>

namespace sinew {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFront = 4096;                              // bytes that tell the format
constexpr std::uint64_t kLargestVolume = std::uint64_t{1} << 40;  // bytes

void requireReadableFile(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::none)
    text::refuse(file, "cannot be read (" + error.message() + "); check its permissions");
  if (!fs::exists(status)) text::refuse(file, "there is no such file; check the path");
  if (fs::is_directory(status))
    text::refuse(
        file,
        "is a folder; name the image file inside it (of a DICOM series: the one that is the segmentation)");
  if (!fs::is_regular_file(status)) text::refuse(file, "is not a regular file; name an image file");
  if (!std::ifstream(file)) text::refuse(file, "cannot be opened for reading; check its permissions");
  if (fs::file_size(file) == 0) text::refuse(file, "is empty; export the segmentation again");
}

bool isNifti(std::string_view front) {
  using namespace std::string_view_literals;
  const auto headerSize = front.substr(0, 4);
  return headerSize == "\x5C\x01\0\0"sv ||
         headerSize == "\0\0\x01\x5C"sv ||                                  // 348: NIfTI-1, either byte order
         headerSize == "\x1C\x02\0\0"sv || headerSize == "\0\0\x02\x1C"sv;  // 540: NIfTI-2
}

bool isMeta(std::string_view front) {
  const auto lines = text::split(front, '\n');
  return std::ranges::any_of(lines, [](std::string_view line) {
    const auto equals = line.find('=');
    const auto key = text::trim(line.substr(0, equals));
    return equals != std::string_view::npos && (key == "NDims" || key == "ObjectType");
  });
}

/// `20 x 30 x 40`
std::string shape(std::span<const std::int64_t> sizes) {
  std::string text;
  for (const std::int64_t size : sizes) text += (text.empty() ? "" : " x ") + std::to_string(size);
  return text;
}

}  // namespace

ImageHeader readImageHeader(const fs::path& file) {
  requireReadableFile(file);
  const std::string front = readFront(file, kFront);
  if (front.starts_with("NRRD")) return readNrrdHeader(file);
  if (isNifti(front)) return readNiftiHeader(file);
  if (isMeta(front)) return readMetaHeader(file);
  text::refuse(
      file,
      "is not an image that Sinew reads (NRRD, NIfTI-1, MetaImage or DICOM SEG); export the segmentation as "
      ".seg.nrrd, .nii.gz or .mha");
}

bool isImageFile(const fs::path& file) {
  requireReadableFile(file);
  const std::string front = readFront(file, kFront);
  return front.starts_with("NRRD") || isNifti(front) || isMeta(front) || isDicom(file);
}

std::string readFront(const fs::path& file, std::size_t count) {
  std::string front(count, '\0');
  front.resize(UnpackStream(file, 0, isGzip(file) ? Packing::Wrapped : Packing::None)
                   .read(std::as_writable_bytes(std::span(front))));
  return front;
}

void requireVolume(const fs::path& file, std::span<const std::int64_t> sizes) {
  if (sizes.size() < 3)
    text::refuse(file, "is a " + std::to_string(sizes.size()) + "-D image (" + shape(sizes) +
                           "); Sinew needs a volume, export all slices into one file");
  if (std::ranges::any_of(sizes.subspan(3), [](std::int64_t size) { return size != 1; }))
    text::refuse(file, "is a " + std::to_string(sizes.size()) + "-D image (" + shape(sizes) +
                           "), perhaps a time series; save one volume of labels");
}

void requireSpacing(const fs::path& file, double spacing, int axis, std::string_view where) {
  if (std::isfinite(spacing) && spacing != 0) return;
  text::refuse(file, "the voxel spacing along axis " + std::to_string(axis) + " is " + text::format(spacing) +
                         " (" + std::string(where) + "); correct it to the distance of the voxels in mm");
}

void requireDirections(const fs::path& file, const Eigen::Matrix3d& axes, std::string_view where) {
  if (axes.allFinite()) {
    const Eigen::Matrix3d unit = axes.colwise().normalized();
    // Below one hundredth of a degree between an axis and the plane of the others nothing can be resolved.
    if (std::abs(unit.determinant()) > 1e-4) return;
  }
  text::refuse(file, "its axis directions are singular or not numbers (" + std::string(where) +
                         "); they must span the space, correct them or export the segmentation again");
}

void requireOrigin(const fs::path& file, const Eigen::Vector3d& origin) {
  if (!origin.allFinite())
    text::refuse(file, "its origin is not a number; correct the header or export the segmentation again");
}

std::uint64_t volumeBytes(const fs::path& file, std::span<const std::int64_t> sizes,
                          std::uint64_t bytesPerValue) {
  std::uint64_t bytes = bytesPerValue;
  for (const std::int64_t size : sizes) {
    if (size < 1) text::refuse(file, "its size is " + shape(sizes) + "; every axis needs at least one voxel");
    if (static_cast<std::uint64_t>(size) > kLargestVolume / bytes || size > std::numeric_limits<int>::max())
      text::refuse(
          file, "its size is " + shape(sizes) +
                    ", more than any memory holds; the header may be damaged, export the segmentation again");
    bytes *= static_cast<std::uint64_t>(size);
  }
  return bytes;
}

void refuseComponents(const fs::path& file, std::string_view what) {
  text::refuse(file, "its voxels are " + std::string(what) + "; save one whole number per voxel, the label");
}

}  // namespace sinew
