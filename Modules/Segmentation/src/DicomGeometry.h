#pragma once

#include "DicomFile.h"
#include "sinew/Segmentation/ImageGeometry.h"

#include <filesystem>
#include <vector>

namespace sinew::dicom {

/// Where the frames lie in one volume.
struct Stack {
  ImageGeometry geometry;
  std::vector<int> slice;  ///< of each frame, along the third axis
};

/// The volume that all frames lie in: the first two axes are those of the frames, the third goes along their
/// normal (or, where a gantry was tilted, along their positions). Its spacing is that of the positions;
/// slices may be missing.
/// @throws std::runtime_error naming the file: frames without a place, of different orientation, at uneven
/// distances, or
///         so far apart that the volume is out of proportion
Stack stackFrames(const std::filesystem::path& file, const File& dicom);

}  // namespace sinew::dicom
