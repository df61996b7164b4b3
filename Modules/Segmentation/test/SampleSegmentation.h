#pragma once

#include "TestImages.h"
#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/Segmentation/WriteSegmentation.h"

#include <numbers>
#include <string>

namespace sinew::test {

inline Tissue sampleTissue(const std::string& name, int layer, std::int32_t label) {
  Tissue result;
  result.name = name;
  result.id = "id of " + name;
  result.layer = layer;
  result.label = label;
  result.color = {1.0 / 3, 0.1, 1};
  result.named = true;
  return result;
}

/// 4 x 3 x 2 voxels, oblique, with numbers that no short decimal holds; the labels 1, 2 and 7 on every layer,
/// a little different from layer to layer.
inline Segmentation sampleSegmentation(int layers = 1) {
  Segmentation s;
  s.geometry.size = {4, 3, 2};
  s.geometry.spacing = {1.0 / 3, 0.7, std::numbers::pi};
  s.geometry.origin = {-1e3 / 7, 1e-7, 2.0 / 3};
  s.geometry.direction = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  s.source = "sample.seg.nrrd";
  for (int layer = 0; layer < layers; ++layer) {
    s.layers.push_back(smallLabels());
    s.layers.back()[static_cast<std::size_t>(layer)] = 1;
    for (const auto& [name, label] : {std::pair{"bone ", 1}, {"fat ", 2}, {"skin ", 7}})
      s.tissues.push_back(sampleTissue(name + std::to_string(layer), layer, label));
  }
  updateTissueTable(s);
  return s;
}

inline Segmentation writtenAndRead(const Segmentation& segmentation) {
  const TempFolder folder;
  writeSegmentation(segmentation, folder / "a.seg.nrrd");
  return readSegmentation(folder / "a.seg.nrrd");
}

}  // namespace sinew::test
