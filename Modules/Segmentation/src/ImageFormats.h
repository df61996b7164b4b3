#pragma once

#include "ImageHeader.h"

#include <Eigen/Core>

#include <span>
#include <string_view>

/// The three header parsers behind readImageHeader, and the checks they share.
/// All throw std::runtime_error, one line that names the file.
namespace sinew {

ImageHeader readNrrdHeader(const std::filesystem::path& file);
ImageHeader readNiftiHeader(const std::filesystem::path& file);
ImageHeader readMetaHeader(const std::filesystem::path& file);

/// The first `count` bytes of a file, unpacked when it is gzipped; fewer when it is shorter.
std::string readFront(const std::filesystem::path& file, std::size_t count);

/// Refuses what has fewer than three axes, or a fourth with more than one image.
void requireVolume(const std::filesystem::path& file, std::span<const std::int64_t> sizes);

/// Refuses a spacing that is zero, NaN or infinite. `axis` counts from 0.
void requireSpacing(const std::filesystem::path& file, double spacing, int axis, std::string_view where);

/// Refuses axis directions that are NaN or span no volume. Columns: the axes, any length.
void requireDirections(const std::filesystem::path& file, const Eigen::Matrix3d& axes,
                       std::string_view where);

void requireOrigin(const std::filesystem::path& file, const Eigen::Vector3d& origin);

/// Bytes of a volume; refuses sizes below 1 and products that no memory holds.
std::uint64_t volumeBytes(const std::filesystem::path& file, std::span<const std::int64_t> sizes,
                          std::uint64_t bytesPerValue);

/// Refuses more than one value per voxel. `what`: "colours", "vectors"
[[noreturn]] void refuseComponents(const std::filesystem::path& file, std::string_view what);

}  // namespace sinew
