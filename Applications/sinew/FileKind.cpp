#include "FileKind.h"

#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/Segmentation/ReadSegmentation.h"

#include <stdexcept>

namespace sinew {

FileKind fileKind(const std::filesystem::path& file) {
  if (isImageFile(file)) return FileKind::Segmentation;
  const MeshFormat* format = findMeshFormat(file.filename().string());
  if (format != nullptr && format->readable) return FileKind::Mesh;
  throw std::runtime_error(file.string() +
                           ": is neither a segmentation (NRRD, NIfTI, MetaImage, DICOM SEG) nor a mesh that "
                           "Sinew reads (" +
                           meshExtensions(&MeshFormat::readable) + ")");
}

}  // namespace sinew
