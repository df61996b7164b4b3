#include "RepairSettings.h"

#include "MeshSettings.h"

#include <fstream>
#include <iterator>

namespace sinew {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLargestScript = 16 << 20;  // bytes

std::map<std::string, std::string> pairs(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> values;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    values[text.substr(0, equals)] = text.substr(equals + 1);
  }
  return values;
}

}  // namespace

std::vector<Option> repairOptions(RepairSettings& settings) {
  return {
      {"--set", &settings.globals, "a global of the script", "NAME=VALUE"},
      {"--grid", &settings.grid,
       "spacing of the level sets; 0: the smallest spacing of the image, but not below half a voxel"},
      smoothingOption(settings.smoothing),
      lutOption(settings.reading),
  };
}

RepairOptions resolved(const RepairSettings& settings, const Segmentation& input) {
  const double voxel = input.geometry.meanSpacing();
  RepairOptions options;
  options.settings = pairs(settings.globals);
  options.scriptName = settings.script;
  options.meshFolder = fs::path(settings.script).parent_path();
  options.gridSpacing = settings.grid.millimetres(voxel);
  options.smoothingVoxels = settings.smoothing.kind == Smoothing::Kind::None ? 0 : 1;
  options.smoothingTime = settings.smoothing.motion(voxel);
  return options;
}

std::string readScript(const std::string& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) throw std::runtime_error(file + ": there is no such script");
  if (fs::file_size(file, error) > kLargestScript)
    throw std::runtime_error(file + ": larger than 16 MB; this is no repair script");
  std::ifstream stream(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.eof() && stream.fail()) throw std::runtime_error(file + ": cannot be read");
  return text;
}

}  // namespace sinew
