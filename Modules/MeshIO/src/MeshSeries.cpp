#include "sinew/MeshIO/MeshSeries.h"

#include "FileFailure.h"

#include <vtk_pugixml.h>

#include <charconv>

namespace sinew {
namespace {

/// pugixml's own follow the locale.
std::string timeText(double value) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, value).ptr};
}

}  // namespace

void writeMeshSeries(const std::vector<SeriesMesh>& series, const std::filesystem::path& file) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  pugi::xml_node root = document.append_child("VTKFile");
  root.append_attribute("type") = "Collection";
  root.append_attribute("version") = "0.1";
  pugi::xml_node collection = root.append_child("Collection");
  for (const SeriesMesh& mesh : series) {
    pugi::xml_node set = collection.append_child("DataSet");
    set.append_attribute("timestep") = timeText(mesh.time).c_str();
    set.append_attribute("file") = mesh.file.c_str();
  }
  if (!document.save_file(file.c_str(), "  ", pugi::format_default, pugi::encoding_utf8))
    fail(file, "cannot be written");
}

}  // namespace sinew
