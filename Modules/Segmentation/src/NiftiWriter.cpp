#include "DeflateWriter.h"
#include "NiftiFields.h"
#include "Text.h"
#include "VoxelFile.h"

#include <Eigen/Geometry>

#include <cstring>
#include <limits>
#include <optional>

// https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h

namespace sinew {

namespace {

constexpr std::size_t kVoxOffsetBytes = nifti::kHeaderBytes + 4;  // four zeros: no extension

std::int16_t niftiCode(ValueType type) {
  switch (type) {
    case ValueType::UInt8:
      return 2;
    case ValueType::Int16:
      return 4;
    case ValueType::UInt16:
      return 512;
    default:
      return 8;
  }
}

/// The fixed header, written field by field.
class NiftiHeader {
 public:
  template <class T>
  void put(std::size_t offset, T value) {
    std::memcpy(bytes_.data() + offset, &value, sizeof value);
  }
  void putReal(std::size_t offset, double value) { put(offset, static_cast<float>(value)); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_ = std::string(kVoxOffsetBytes, '\0');
};

/// The columns of the axes, in RAS, and the origin.
Eigen::Matrix<double, 3, 4> rasRows(const ImageGeometry& geometry) {
  Eigen::Matrix<double, 3, 4> rows = geometry.indexToPhysical().matrix().topRows<3>();
  rows.topRows<2>() *= -1;
  return rows;
}

/// A qform is a rotation, a reflection of the third axis (qfac) and spacings.
struct Qform {
  Eigen::Quaterniond rotation;
  double qfac;
};

/// Empty when the axes are not at right angles, which a qform cannot say.
std::optional<Qform> qform(const Eigen::Matrix<double, 3, 4>& rows) {
  constexpr double rightAngle = 1e-6;  // cosine; single precision resolves no less
  Eigen::Matrix3d axes = rows.leftCols<3>().colwise().normalized();
  if (!(axes.transpose() * axes).isIdentity(rightAngle)) return std::nullopt;
  const double qfac = axes.determinant() < 0 ? -1 : 1;
  axes.col(2) *= qfac;
  Eigen::Quaterniond rotation(axes);
  rotation.normalize();
  if (rotation.w() < 0) rotation.coeffs() *= -1;  // the header has no room for w, and takes it as positive
  return Qform{rotation, qfac};
}

void putSpace(NiftiHeader& header, const ImageGeometry& geometry) {
  constexpr std::int16_t scannerAnatomical = 1;
  constexpr char millimetres = 2;
  const auto rows = rasRows(geometry);
  header.put(nifti::kUnits, millimetres);
  for (int axis = 0; axis < 3; ++axis)
    header.putReal(nifti::kPixdim + 4 * (axis + 1), geometry.spacing[axis]);
  header.putReal(nifti::kPixdim, 1);
  if (const auto q = qform(rows)) {
    header.put(nifti::kQformCode, scannerAnatomical);
    header.putReal(nifti::kPixdim, q->qfac);
    for (int i = 0; i < 3; ++i) {
      header.putReal(nifti::kQuatern + 4 * i, q->rotation.vec()[i]);
      header.putReal(nifti::kQuatern + 4 * (3 + i), rows(i, 3));
    }
  }
  header.put(nifti::kSformCode, scannerAnatomical);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      header.putReal(nifti::kSrow + 16 * row + 4 * column, rows(row, column));
}

NiftiHeader niftiHeader(const ImageGeometry& geometry, const VoxelType& type) {
  constexpr std::int16_t labels = 1002;
  NiftiHeader header;
  header.put(0, static_cast<std::int32_t>(nifti::kHeaderBytes));
  header.put(nifti::kDim, std::int16_t{3});
  for (int axis = 0; axis < 7; ++axis)
    header.put(nifti::kDim + 2 * (axis + 1), static_cast<std::int16_t>(axis < 3 ? geometry.size[axis] : 1));
  header.put(nifti::kIntentCode, labels);
  header.put(nifti::kDatatype, niftiCode(type.type));
  header.put(nifti::kBitpix, static_cast<std::int16_t>(8 * bytesOf(type.type)));
  header.putReal(nifti::kVoxOffset, kVoxOffsetBytes);
  header.putReal(nifti::kSlope, 1);
  putSpace(header, geometry);
  header.put(nifti::kMagic, std::array{'n', '+', '1', '\0'});
  return header;
}

void requireNiftiSize(const std::filesystem::path& file, const Eigen::Vector3i& size) {
  constexpr int most = std::numeric_limits<std::int16_t>::max();
  if (size.maxCoeff() > most)
    text::refuse(file, "an axis has " + std::to_string(size.maxCoeff()) + " voxels, NIfTI-1 holds " +
                           std::to_string(most) + "; write .nrrd or .mha");
}

}  // namespace

void writeNifti(const Segmentation& segmentation, const std::filesystem::path& file) {
  requireNiftiSize(file, segmentation.geometry.size);
  const VoxelType& type = smallestVoxelType(segmentation);
  const std::string header = niftiHeader(segmentation.geometry, type).bytes();
  const auto headerBytes = std::as_bytes(std::span(header));
  writeFile(file, [&](std::ostream& out) {
    if (text::lower(file.extension().string()) != ".gz") {
      out << header;
      forVoxelBytes(segmentation, type, [&](std::span<const std::byte> bytes) {
        out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      });
      return;
    }
    DeflateWriter gzip(out, Wrapper::Gzip);
    gzip.write(headerBytes);
    forVoxelBytes(segmentation, type, [&](std::span<const std::byte> bytes) { gzip.write(bytes); });
    gzip.finish();
  });
}

}  // namespace sinew
