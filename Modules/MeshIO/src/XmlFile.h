#pragma once

#include "ClassicLocale.h"
#include "VtkErrorTrap.h"

#include <vtkDataObject.h>
#include <vtkErrorCode.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

namespace sinew {

/// VTK's writer checks its stream between arrays, not when it closes the file.
inline bool endsLikeVtkXml(const std::filesystem::path& file) {
  const std::string end = "</VTKFile>\n";
  std::ifstream stream(file, std::ios::binary);
  std::string found(end.size(), '\0');
  stream.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  stream.read(found.data(), static_cast<std::streamsize>(found.size()));
  return stream && found == end;
}

/// Writes a data set by one of VTK's XML writers, zlib-compressed, in the form that the most readers take.
/// @throws std::runtime_error saying what went wrong
template <class Writer>
void writeXml(vtkDataObject* data, const std::filesystem::path& file) {
  /// Fast: on tet meshes level 1 is within a few percent of the default level's size.
  constexpr int kCompressionLevel = 1;
  /// FEBio Studio reads an array only when it is one block; the bound keeps the compressor's buffer small for
  /// huge meshes.
  constexpr std::size_t kBlockBytes = std::size_t{1} << 26;
  const ClassicLocale locale;
  const VtkErrorTrap trap;
  const auto writer = vtkSmartPointer<Writer>::New();
  writer->SetInputData(data);
  writer->SetFileName(file.c_str());
  writer->SetDataModeToBinary();  // inline base64: FEBio Studio and older meshio read no appended data
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(kCompressionLevel);
  writer->SetBlockSize(kBlockBytes);
  const bool wrote = writer->Write() != 0;
  if (writer->GetErrorCode() != vtkErrorCode::NoError)
    throw std::runtime_error(vtkErrorCode::GetStringFromErrorCode(writer->GetErrorCode()));
  if (trap.failed()) throw std::runtime_error(trap.firstError());
  if (!wrote || !endsLikeVtkXml(file)) throw std::runtime_error("the file is incomplete; is the disk full?");
}

}  // namespace sinew
