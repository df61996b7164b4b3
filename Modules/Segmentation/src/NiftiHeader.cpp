#include "ImageFormats.h"
#include "NiftiFields.h"
#include "Text.h"
#include "UnpackStream.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

// https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h

namespace sinew {

namespace {

namespace fs = std::filesystem;
using namespace nifti;

/// The fixed header, read field by field.
class NiftiFields {
 public:
  NiftiFields(std::string bytes, bool swapped) : bytes_(std::move(bytes)), swapped_(swapped) {}

  bool swapped() const { return swapped_; }
  std::int16_t integer(std::size_t offset) const { return read<std::int16_t>(offset); }
  float real(std::size_t offset) const { return read<float>(offset); }
  std::string_view characters(std::size_t offset, std::size_t count) const {
    return std::string_view(bytes_).substr(offset, count);
  }

 private:
  template <class T>
  T read(std::size_t offset) const {
    std::array<char, sizeof(T)> raw;
    std::memcpy(raw.data(), bytes_.data() + offset, sizeof(T));
    if (swapped_) std::ranges::reverse(raw);
    return std::bit_cast<T>(raw);
  }

  std::string bytes_;
  bool swapped_;
};

NiftiFields readNiftiFields(const fs::path& file) {
  using namespace std::string_view_literals;
  const std::string front = readFront(file, kHeaderBytes);
  if (front.size() < kHeaderBytes)
    text::refuse(file, "its NIfTI header is truncated; export the segmentation again");
  const bool swapped = front[0] == 0;
  const NiftiFields fields(front, swapped);
  const bool two = front[swapped ? 2 : 1] == 2;
  if (two) text::refuse(file, "is a NIfTI-2 file; save it as NIfTI-1 (.nii.gz) or as .seg.nrrd");
  if (fields.characters(kMagic, 4) == "ni1\0"sv)
    text::refuse(file, "is half of a .hdr/.img pair; save the image as one .nii.gz file");
  if (fields.characters(kMagic, 4) != "n+1\0"sv)
    text::refuse(file,
                 "is an Analyze file or a damaged NIfTI file; save it as NIfTI-1 (.nii.gz) or as .seg.nrrd");
  const std::string name = text::lower(file.filename().string());
  if (!name.ends_with(".nii") && !name.ends_with(".nii.gz"))
    text::refuse(file, "is a NIfTI file under another name; rename it to .nii or .nii.gz");
  return fields;
}

std::vector<std::int64_t> sizes(const fs::path& file, const NiftiFields& fields) {
  const int dimension = fields.integer(kDim);
  if (dimension < 1 || dimension > 7)
    text::refuse(file, "its NIfTI header is damaged (dim[0] is " + std::to_string(dimension) +
                           "); export the segmentation again");
  std::vector<std::int64_t> result;
  for (int axis = 1; axis <= dimension; ++axis) result.push_back(fields.integer(kDim + 2 * axis));
  return result;
}

void checkGeometry(const fs::path& file, const NiftiFields& fields) {
  for (int axis = 0; axis < 3; ++axis)
    requireSpacing(file, fields.real(kPixdim + 4 * (axis + 1)), axis, "NIfTI `pixdim`");
  if (fields.integer(kQformCode) <= 0) return;
  for (int i = 0; i < 6; ++i)
    if (!std::isfinite(fields.real(kQuatern + 4 * i)))
      text::refuse(file, "its NIfTI qform holds a value that is not a number; export the segmentation again");
}

/// How many mm are one unit of the header; unknown units are taken for mm.
double unitMm(const NiftiFields& fields) {
  constexpr int meter = 1, micron = 3, spaceBits = 7;
  const int unit = fields.characters(kUnits, 1)[0] & spaceBits;
  return unit == meter ? 1e3 : unit == micron ? 1e-3 : 1;
}

/// The geometry of the sform, turned from NIfTI's RAS to LPS.
std::optional<ImageGeometry> sform(const fs::path& file, const NiftiFields& fields,
                                   const std::vector<std::int64_t>& shape) {
  if (fields.integer(kSformCode) <= 0) return std::nullopt;
  Eigen::Matrix<double, 3, 4> rows;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) rows(row, column) = fields.real(kSrow + 16 * row + 4 * column);
  rows.topRows(2) *= -1;
  rows *= unitMm(fields);
  requireDirections(file, rows.leftCols(3), "NIfTI sform");
  requireOrigin(file, rows.col(3));
  ImageGeometry geometry;
  for (int axis = 0; axis < 3; ++axis) geometry.size[axis] = static_cast<int>(shape[axis]);
  geometry.spacing = rows.leftCols(3).colwise().norm();
  geometry.direction = rows.leftCols(3).colwise().normalized();
  geometry.origin = rows.col(3);
  return geometry;
}

ValueType valueType(const fs::path& file, int datatype) {
  switch (datatype) {
    case 2:
      return ValueType::UInt8;
    case 4:
      return ValueType::Int16;
    case 8:
      return ValueType::Int32;
    case 16:
      return ValueType::Float32;
    case 64:
      return ValueType::Float64;
    case 256:
      return ValueType::Int8;
    case 512:
      return ValueType::UInt16;
    case 768:
      return ValueType::UInt32;
    case 1024:
      return ValueType::Int64;
    case 1280:
      return ValueType::UInt64;
    case 32:
    case 1792:
    case 2048:
      refuseComponents(file, "complex numbers");
    case 128:
    case 2304:
      refuseComponents(file, "colours (RGB)");
    default:
      break;
  }
  text::refuse(file, "its NIfTI datatype is " + std::to_string(datatype) + "; save it with an integer type");
}

/// A fifth axis holds the components of a vector or a tensor.
void requireSingleValues(const fs::path& file, const NiftiFields& fields,
                         const std::vector<std::int64_t>& shape) {
  constexpr int symmetricMatrix = 1005;
  if (shape.size() >= 5 && shape[4] > 1)
    refuseComponents(file, fields.integer(kIntentCode) == symmetricMatrix ? "tensors" : "vectors");
}

ImagePayload payload(const fs::path& file, const NiftiFields& fields,
                     const std::vector<std::int64_t>& shape) {
  ImagePayload result{.file = file, .compressed = isGzip(file)};
  result.type = valueType(file, fields.integer(kDatatype));
  result.bytes = volumeBytes(file, shape, bytesOf(result.type));
  result.swapped = fields.swapped();
  const float offset = fields.real(kVoxOffset);
  if (!(offset >= 0 && offset < 1e9f))
    text::refuse(file, "its NIfTI header is damaged (vox_offset is " + text::format(offset) +
                           "); export the segmentation again");
  result.skip = std::max<std::uint64_t>(static_cast<std::uint64_t>(offset), kHeaderBytes);
  const float slope = fields.real(kSlope), intercept = fields.real(kIntercept);
  if (std::isfinite(slope) && std::isfinite(intercept) && slope != 0) {
    result.slope = slope;
    result.intercept = intercept;
  }
  return result;
}

}  // namespace

ImageHeader readNiftiHeader(const fs::path& file) {
  const NiftiFields fields = readNiftiFields(file);
  const auto shape = sizes(file, fields);
  ImageHeader header{.format = ImageFormat::Nifti, .payload = payload(file, fields, shape)};
  requireSingleValues(file, fields, shape);
  requireVolume(file, shape);
  checkGeometry(file, fields);
  header.sform = sform(file, fields, shape);
  return header;
}

}  // namespace sinew
