#include "MeshFileSettings.h"

#include "sinew/MeshIO/MeshFormats.h"
#include "sinew/MeshIO/MeshPresets.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>

namespace sinew {
namespace {

struct Unit {
  std::string_view name;
  double perMm;
};
constexpr std::array kUnits{Unit{"mm", 1}, Unit{"cm", 0.1}, Unit{"m", 0.001}};

std::vector<std::string> formatNames() {
  std::vector<std::string> names;
  for (const MeshFormat& format : meshFormats()) names.emplace_back(format.extension.substr(1));
  return names;
}

std::vector<std::string> presetNames() {
  std::vector<std::string> names;
  for (const MeshPreset& preset : meshPresets()) names.emplace_back(preset.name);
  return names;
}

std::vector<std::string> unitNames() {
  std::vector<std::string> names;
  for (const Unit& unit : kUnits) names.emplace_back(unit.name);
  return names;
}

}  // namespace

std::vector<Option> meshFileOptions(MeshFileSettings& settings) {
  return {
      {.flags = "--for",
       .target = &settings.preset,
       .help = "the program that is to read the meshes: chooses format, tags and unit",
       .choices = presetNames()},
      {.flags = "--space",
       .target = &settings.space,
       .help = "axes of the coordinates; default LPS",
       .choices = {"LPS", "RAS"}},
      {"--no-space-tag", &settings.noSpaceTag,
       "do not say in the file which axes it has: meshio and FEBio Studio refuse the mark in .vtu"},
      {.flags = "--unit",
       .target = &settings.unit,
       .help = "of the coordinates; default mm, the only one with --for slicer",
       .choices = unitNames()},
      {"--quadratic", &settings.quadratic, "tets of ten nodes, in .msh, .inp, .feb and .exo"},
  };
}

void checkMeshFiles(const MeshFileSettings& settings, std::string_view file) {
  const MeshPreset* preset = findMeshPreset(settings.preset);
  if (preset != nullptr && preset->onlyMm && !settings.unit.empty() && settings.unit != "mm")
    throw CLI::ValidationError("--unit", settings.unit + ": --for " + settings.preset +
                                             " takes mm, the only unit that the program knows");
  const MeshFormat* format = findMeshFormat(file);
  if (settings.quadratic && format != nullptr && !format->quadratic)
    throw CLI::ValidationError("--quadratic", std::string(format->extension) + " has no tets of ten nodes; " +
                                                  meshExtensions(&MeshFormat::quadratic) + " have them");
}

WriteMeshOptions resolved(const MeshFileSettings& settings) {
  WriteMeshOptions options;
  if (const MeshPreset* preset = findMeshPreset(settings.preset)) options = preset->options;
  if (!settings.space.empty()) options.space = settings.space == "RAS" ? Space::Ras : Space::Lps;
  if (!settings.unit.empty()) options.perMm = std::ranges::find(kUnits, settings.unit, &Unit::name)->perMm;
  if (settings.noSpaceTag) options.spaceTag = false;
  if (settings.quadratic) options.quadratic = true;
  return options;
}

std::string_view standardExtension(const MeshFileSettings& settings) {
  const MeshPreset* preset = findMeshPreset(settings.preset);
  return preset != nullptr ? preset->extension : meshFormats().front().extension;
}

Option formatOption(std::string& format) {
  return {.flags = "--format",
          .target = &format,
          .help = "kind of the mesh files; default vtu",
          .choices = formatNames()};
}

std::string_view unitOf(const WriteMeshOptions& options) {
  return std::ranges::find(kUnits, options.perMm, &Unit::perMm)->name;
}

}  // namespace sinew
