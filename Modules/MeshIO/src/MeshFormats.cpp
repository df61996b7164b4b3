#include "sinew/MeshIO/MeshFormats.h"

#include "AbaqusFile.h"
#include "ExodusFile.h"
#include "FebioFile.h"
#include "GmshFile.h"
#include "LegacyVtkFile.h"
#include "MeshFormatTable.h"
#include "SurfaceWriters.h"
#include "VtuFile.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace sinew {
namespace {

using enum MeshContent;

constexpr std::array kRows{
    MeshFormatRow{{".vtu", "VTK XML unstructured grid", Volume, true, false, true}, &writeVtu, &readVtu},
    MeshFormatRow{{".vtk", "legacy VTK 4.2", Volume, true, false, true}, &writeLegacyVtk, &readLegacyVtk},
    MeshFormatRow{{".msh", "Gmsh 2.2", Volume, true, true, false}, &writeGmsh, &readGmsh},
    MeshFormatRow{{".inp", "Abaqus and CalculiX", Volume, false, true, false}, &writeAbaqus, nullptr},
    MeshFormatRow{{".feb", "FEBio 4.0", Volume, false, true, false}, &writeFebio, nullptr},
    MeshFormatRow{{".exo", "Exodus II", Volume, false, true, false}, &writeExodus, nullptr},
    MeshFormatRow{{".stl", "stereolithography, binary", Surface, false, false, false}, &writeStl, nullptr},
    MeshFormatRow{{".ply", "Stanford polygons, binary", Surface, false, false, false}, &writePly, nullptr},
    MeshFormatRow{{".obj", "Wavefront", Surface, false, false, false}, &writeObj, nullptr},
    MeshFormatRow{{".vtp", "VTK XML polygons", Surface, false, false, false}, &writeVtp, nullptr},
};

bool endsWith(std::string_view name, std::string_view extension) {
  const auto same = [](unsigned char a, char b) { return std::tolower(a) == b; };
  return name.size() > extension.size() &&
         std::ranges::equal(name.substr(name.size() - extension.size()), extension, same);
}

}  // namespace

const MeshFormatRow* findMeshFormatRow(std::string_view fileName) {
  const auto found = std::ranges::find_if(
      kRows, [&](const MeshFormatRow& row) { return endsWith(fileName, row.format.extension); });
  return found == kRows.end() ? nullptr : &*found;
}

std::span<const MeshFormat> meshFormats() {
  static const auto formats = [] {
    std::array<MeshFormat, kRows.size()> list{};
    std::ranges::transform(kRows, list.begin(), &MeshFormatRow::format);
    return list;
  }();
  return formats;
}

const MeshFormat* findMeshFormat(std::string_view fileName) {
  const MeshFormatRow* row = findMeshFormatRow(fileName);
  return row != nullptr ? &row->format : nullptr;
}

std::string meshExtensions(bool MeshFormat::*only) {
  std::vector<std::string_view> extensions;
  for (const MeshFormat& format : meshFormats())
    if (only == nullptr || format.*only) extensions.push_back(format.extension);
  std::string text;
  for (std::size_t i = 0; i < extensions.size(); ++i)
    text += std::string(i == 0 ? "" : i + 1 < extensions.size() ? ", " : " and ").append(extensions[i]);
  return text;
}

}  // namespace sinew
