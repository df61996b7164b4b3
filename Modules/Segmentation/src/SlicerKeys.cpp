#include "SlicerKeys.h"

#include "Text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <set>
#include <string_view>

namespace sinew::slicer {

namespace {

constexpr std::string_view kRepresentation = "Segmentation_MasterRepresentation";
constexpr std::string_view kContained = "Segmentation_ContainedRepresentationNames";
constexpr std::string_view kOffset = "Segmentation_ReferenceImageExtentOffset";
constexpr std::string_view kLegacyExtent = "Segmentation_Extent";  // makes Slicer refuse the file

const std::string* find(const Keys& keys, std::string_view key) {
  const auto found = keys.find(std::string(key));
  return found == keys.end() ? nullptr : &found->second;
}

/// Reads the keys of segment `index`.
class SegmentKeys {
 public:
  SegmentKeys(const std::filesystem::path& file, const Keys& keys, int index)
      : file_(file), keys_(keys), prefix_("Segment" + std::to_string(index) + "_") {}

  const std::string* find(std::string_view key) const {
    return slicer::find(keys_, prefix_ + std::string(key));
  }
  std::string key(std::string_view name) const { return prefix_ + std::string(name); }

  std::string textOr(std::string_view key, const std::string& missing) const {
    const std::string* value = find(key);
    return value ? text::toUtf8(*value) : missing;
  }

  std::int32_t integerOr(std::string_view key, std::int32_t missing) const {
    const std::string* value = find(key);
    if (!value) return missing;
    const auto number = text::number<std::int32_t>(*value);
    if (!number)
      text::refuse(file_, prefix_ + std::string(key) + " is `" + text::printable(*value) +
                              "`, which is no whole number; correct the header");
    return *number;
  }

 private:
  const std::filesystem::path& file_;
  const Keys& keys_;
  std::string prefix_;
};

std::optional<std::array<double, 3>> parseColor(const std::string* value) {
  if (!value) return std::nullopt;
  const auto words = text::words(*value);
  if (words.size() != 3) return std::nullopt;
  std::array<double, 3> color;
  for (int c = 0; c < 3; ++c) {
    const auto number = text::number<double>(words[c]);
    if (!number || !(*number >= 0 && *number <= 1)) return std::nullopt;
    color[c] = *number;
  }
  return color;
}

std::array<double, 3> color(const SegmentKeys& keys) {
  for (const std::string_view key : {"Color", "DefaultColor"})
    if (const auto color = parseColor(keys.find(key))) return *color;
  return {0.5, 0.5, 0.5};
}

/// `key:value|key:value|`
std::map<std::string, std::string> parseTags(const std::string& value) {
  std::map<std::string, std::string> tags;
  for (const std::string_view tag : text::split(value, '|')) {
    const auto colon = tag.find(':');
    if (colon != std::string_view::npos)
      tags.insert_or_assign(std::string(tag.substr(0, colon)), tag.substr(colon + 1));
  }
  return tags;
}

/// The separators of tags cannot stand inside them.
std::string formatTags(const std::map<std::string, std::string>& tags) {
  std::string result;
  const auto append = [&](std::string_view text, std::string_view separators) {
    for (const char c : text) result += separators.find(c) == std::string_view::npos ? c : '/';
  };
  for (const auto& [key, value] : tags) {
    append(key, "|:");
    result += ':';
    append(value, "|");
    result += '|';
  }
  return result;
}

bool isSegmentKey(std::string_view key) {
  return key.starts_with("Segment") && key.size() > 7 && std::isdigit(static_cast<unsigned char>(key[7]));
}

/// The id, with a number behind it when an earlier segment has the same.
std::string uniqueId(const Tissue& tissue, std::set<std::string>& taken) {
  const std::string wanted = tissue.id.empty() ? tissue.name : tissue.id;
  std::string id = wanted;
  for (int n = 2; !taken.insert(id).second; ++n) id = wanted + "_" + std::to_string(n);
  return id;
}

std::string formatColor(const std::array<double, 3>& color) {
  return text::format(color[0]) + " " + text::format(color[1]) + " " + text::format(color[2]);
}

/// Slicer crops a layer to the extents of its segments: the whole image is always right.
std::string formatExtent(const Segmentation& segmentation, const Tissue& tissue) {
  if (tissue.voxels == 0) return "0 -1 0 -1 0 -1";
  const Eigen::Vector3i last = segmentation.geometry.size - Eigen::Vector3i::Ones();
  return "0 " + std::to_string(last.x()) + " 0 " + std::to_string(last.y()) + " 0 " +
         std::to_string(last.z());
}

}  // namespace

bool isSegmentation(const Keys& keys) {
  return keys.contains("Segment0_ID") || keys.contains(std::string(kRepresentation));
}

bool isVolumeSeries(const Keys& keys) {
  // Slicer's MultiVolume and Sequences modules, and diffusion images.
  static constexpr std::array<std::string_view, 3> marks{"MultiVolume.", "axis 0 index", "DWMRI_"};
  return std::ranges::any_of(keys, [](const auto& pair) {
    return std::ranges::any_of(marks, [&](std::string_view mark) { return pair.first.starts_with(mark); });
  });
}

std::vector<Tissue> readSegments(const std::filesystem::path& file, const Keys& keys, int layers) {
  std::vector<Tissue> segments;
  for (int index = 0;; ++index) {
    const SegmentKeys segment(file, keys, index);
    const std::string* id = segment.find("ID");
    if (!id) return segments;
    Tissue& tissue = segments.emplace_back();
    tissue.id = text::toUtf8(*id);
    tissue.name = segment.textOr("Name", tissue.id);
    tissue.layer = segment.integerOr("Layer", index);
    tissue.label = segment.integerOr("LabelValue", 1);
    tissue.color = color(segment);
    tissue.named = true;
    if (const std::string* tags = segment.find("Tags")) tissue.tags = parseTags(text::toUtf8(*tags));
    const std::string who = "segment `" + text::printable(tissue.name) + "` ";
    if (tissue.layer < 0 || tissue.layer >= layers)
      text::refuse(file,
                   who + "lies on layer " + std::to_string(tissue.layer) +
                       (segment.find("Layer") ? "" : " (what a missing " + segment.key("Layer") + " means)") +
                       ", but the file has " + std::to_string(layers) + "; correct " + segment.key("Layer"));
    if (tissue.label == 0)
      text::refuse(
          file, who + "has the label value 0, which is the background; correct " + segment.key("LabelValue"));
  }
}

Keys otherKeys(const Keys& keys) {
  Keys result;
  for (const auto& [key, value] : keys)
    if (!isSegmentKey(key) && !key.starts_with("ITK_") && key != kRepresentation && key != kLegacyExtent)
      result.emplace(key, value);
  return result;
}

std::vector<std::pair<std::string, std::string>> writeKeys(const Segmentation& segmentation) {
  std::vector<std::pair<std::string, std::string>> result;
  const auto add = [&](std::string_view key, std::string value) {
    result.emplace_back(key, std::move(value));
  };
  const auto carried = [&](std::string_view key, const char* missing) {
    const std::string* value = find(segmentation.keys, key);
    return value ? *value : std::string(missing);
  };
  // Slicer offers a file as a segmentation when `Segmentation_` stands in its first 800 characters.
  add(kRepresentation, "Binary labelmap");
  add(kContained, carried(kContained, "Binary labelmap|"));
  add(kOffset, carried(kOffset, "0 0 0"));

  std::vector<Tissue> segments = segmentation.tissues;
  segments.insert(segments.end(), segmentation.emptyTissues.begin(), segmentation.emptyTissues.end());
  std::set<std::string> ids;
  for (std::size_t index = 0; index < segments.size(); ++index) {
    const Tissue& tissue = segments[index];
    const std::string prefix = "Segment" + std::to_string(index) + "_";
    add(prefix + "ID", uniqueId(tissue, ids));
    add(prefix + "Name", tissue.name);
    add(prefix + "NameAutoGenerated", "0");
    add(prefix + "Color", formatColor(tissue.color));
    add(prefix + "ColorAutoGenerated", "0");
    add(prefix + "LabelValue", std::to_string(tissue.label));
    add(prefix + "Layer", std::to_string(tissue.layer));
    add(prefix + "Extent", formatExtent(segmentation, tissue));
    add(prefix + "Tags", formatTags(tissue.tags));
  }
  for (const auto& [key, value] : otherKeys(segmentation.keys))
    if (key != kContained && key != kOffset) add(key, value);
  return result;
}

}  // namespace sinew::slicer
