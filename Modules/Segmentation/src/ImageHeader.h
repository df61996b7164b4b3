#pragma once

#include "ImagePayload.h"
#include "sinew/Segmentation/ImageGeometry.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace sinew {

/// Key/value pairs of a NRRD header, read or written: 3,300 segments. NrrdIO compares each with all before it.
inline constexpr std::size_t kMostNrrdKeys = 30'000;

enum class ImageFormat { Nrrd, Nifti, Meta };

/// What the raw header says beyond what ITK tells.
struct ImageHeader {
  ImageFormat format = ImageFormat::Nrrd;
  std::map<std::string, std::string> keys{};  ///< NRRD key/value pairs, unescaped
  bool list = false;                          ///< NRRD: the components are a list, not a vector or a colour
  std::optional<ImagePayload>
      payload{};  ///< empty when the voxels are spread over several files, text, or skipped to
  std::optional<ImageGeometry> sform{};  ///< NIfTI: what the sform says, where it is set
};

/// Tells the format from the content and reads the raw header, refusing what ITK would silently repair or
/// crash on: zero or NaN spacing, singular directions, sizes that do not fit the file, missing data files;
/// and what is no volume of single values.
/// @throws std::runtime_error: one line that names the file, what is wrong and what to do.
ImageHeader readImageHeader(const std::filesystem::path& file);

}  // namespace sinew
