#include "MeshSettings.h"

#include "sinew/Pipeline/MethodSettings.h"

#include <CLI/CLI.hpp>

namespace sinew {
namespace {

/// TISSUE=VALUE pairs of a list.
template <typename Value>
std::map<std::string, Value> parsePairs(const std::string& option, const std::vector<std::string>& texts,
                                        Value (*parse)(std::string_view)) {
  std::map<std::string, Value> values;
  for (const std::string& text : texts) {
    const auto equals = text.rfind('=');
    try {
      values[text.substr(0, equals)] = parse(text.substr(equals + 1));
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError(option, error.what());
    }
  }
  return values;
}

}  // namespace

Option lutOption(ReadSegmentationOptions& reading) {
  return {"--lut", &reading.lut, "colour table with the names of the labels", "FILE"};
}

Option fractionalOption(ReadSegmentationOptions& reading) {
  return {"--fractional-threshold", &reading.fractionalThreshold,
          "smallest share of a voxel, in (0, 1], that counts as tissue in fractional DICOM SEG, which is "
          "refused without",
          "SHARE"};
}

Option smoothingOption(Smoothing& smoothing) {
  return {"--smoothing", &smoothing,
          "none: keep the voxels' stairs; light: a Gauss of one voxel; a time (2mm2) or a length "
          "(1mm, 2vox): motion by mean curvature too"};
}

std::vector<Option> tissueOptions(MeshSettings& settings) {
  return {{.flags = "--tissue",
           .target = &settings.tissues,
           .help = "mesh only this tissue; default all",
           .form = "NAME|LABEL",
           .mayHoldCommas = true},
          lutOption(settings.reading)};
}

std::vector<Option> meshingOptions(MeshSettings& settings) {
  MeshTissuesOptions& meshing = settings.meshing;
  return {
      {"--edge-length", &meshing.edgeLength, "cube size of the lattice at the surface"},
      {"--max-edge-length", &meshing.maxEdgeLength, "cube size deep inside; 0: eight times the edge length"},
      {"--min-edge-length", &meshing.minEdgeLength,
       "smallest cube that refinement may make; 0: the level set's spacing, and where more than 1 % of the "
       "volume would be lost half a voxel, or a quarter of the edge length where that is more"},
      {"--size", &settings.sizes, "edge length of one tissue", "TISSUE=LENGTH"},
      {.flags = "--target-tets",
       .target = &meshing.targetTets,
       .help = "choose the edge length of each tissue without a --size for so many tets, within 10 %; 0: off",
       .least = 0},
      {.flags = "--curvature",
       .target = &meshing.curvature,
       .help = "refine where cube size times curvature exceeds this; 0: nowhere, nor thin parts",
       .least = 0},
      {"--tolerance", &meshing.tolerance,
       "refine where cube size^2 times curvature / 8 exceeds this; 0: nowhere"},
      {.flags = "--levels",
       .target = &meshing.levels,
       .help = "largest number of lattice levels; 0: as many as the sizes ask for",
       .least = 0},
      smoothingOption(meshing.smoothing),
      {"--smooth", &settings.smoothings, "smoothing of one tissue", "TISSUE=HOW"},
      {.flags = "--method",
       .target = &settings.method,
       .help = "how the mesh is fitted to the surface",
       .choices = methodNames()},
      {.flags = "--physics",
       .target = &settings.physics,
       .help = "an option of the methods with physics; keys and defaults: " + physicsHelp(),
       .form = "KEY=VALUE"},
      {"--preserve-volume", &meshing.preserveVolume,
       "keep the volume of the level set within 0.1 % instead of 0.5 %"},
      {"--with-quality", &meshing.withQuality,
       "write the arrays aspect_ratio, min_dihedral_deg, max_dihedral_deg and phi to the meshes"},
  };
}

MeshTissuesOptions resolved(const MeshSettings& settings) {
  MeshTissuesOptions options = settings.meshing;
  options.sizes = parsePairs("--size", settings.sizes, &parseLength);
  options.smoothings = parsePairs("--smooth", settings.smoothings, &parseSmoothing);
  options.method = parseMethod(settings.method);
  for (const std::string& text : settings.physics) {
    try {
      setPhysics(text, options.method, options.physics);
    } catch (const std::invalid_argument& error) {
      throw CLI::ValidationError("--physics", error.what());
    }
  }
  return options;
}

}  // namespace sinew
