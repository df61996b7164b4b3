#include "sinew/Simulation/BsplineSolidFile.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>

namespace sinew {
namespace {

using Json = nlohmann::json;

/// std::invalid_argument here becomes an error that names the file.
[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

Json parsed(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse("no such file, or not readable");
  const Json json = Json::parse(stream, nullptr, false);
  if (json.is_discarded()) refuse("is no JSON");
  if (!json.is_object()) refuse(R"(holds no object {"counts": ..., "points": ...})");
  for (const auto& [key, value] : json.items())
    if (key != "counts" && key != "points" && key != "space")
      refuse("unknown key \"" + key + "\"; known are \"counts\", \"points\" and \"space\"");
  return json;
}

std::array<int, 3> countsOf(const Json& json) {
  constexpr int kMost = 1000;
  const auto counts = json.find("counts");
  bool good = counts != json.end() && counts->is_array() && counts->size() == 3;
  std::array<int, 3> numbers{};
  for (std::size_t axis = 0; good && axis < 3; ++axis) {
    const Json& count = (*counts)[axis];
    good = count.is_number_integer() && count >= 2 && count <= kMost;
    if (good) numbers[axis] = count.get<int>();
  }
  if (!good) refuse("\"counts\" must be three whole numbers from 2 to " + std::to_string(kMost));
  return numbers;
}

/// 1 for LPS, -1 for RAS: what x and y are multiplied with.
double turnOf(const Json& json) {
  const Json space = json.value("space", Json("LPS"));
  if (space == "LPS") return 1;
  if (space == "RAS") return -1;
  refuse("\"space\" must be \"LPS\" or \"RAS\"");
}

NodeVectors pointsOf(const Json& json) {
  const auto list = json.find("points");
  if (list == json.end() || !list->is_array()) refuse("\"points\" must be a list of [x, y, z]");
  const double turn = turnOf(json);
  NodeVectors points;
  for (const Json& point : *list) {
    const bool good = point.is_array() && point.size() == 3 && point[0].is_number() && point[1].is_number() &&
                      point[2].is_number();
    if (!good) refuse("control point " + std::to_string(points.size()) + " is not [x, y, z] in numbers");
    points.emplace_back(turn * point[0].get<double>(), turn * point[1].get<double>(), point[2].get<double>());
    if (!points.back().allFinite())
      refuse("control point " + std::to_string(points.size() - 1) + " is not finite");
  }
  return points;
}

}  // namespace

BsplineSolid readBsplineSolid(const std::filesystem::path& file) try {
  const Json json = parsed(file);
  return {countsOf(json), pointsOf(json)};
} catch (const std::invalid_argument& error) {
  throw std::runtime_error(file.string() + ": " + error.what());
}

}  // namespace sinew
