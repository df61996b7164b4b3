#pragma once

#include "sinew/Segmentation/Segmentation.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// The key/value pairs of Slicer's segmentation files: Segmentation_* for the file, SegmentN_* per segment.
/// Source: vtkMRMLSegmentationStorageNode.cxx of 3D Slicer.
namespace sinew::slicer {

using Keys = std::map<std::string, std::string>;

/// Whether the keys make a file a Slicer segmentation.
bool isSegmentation(const Keys& keys);

/// Whether the keys tell of a series in time or of diffusion images, which are lists of volumes too.
bool isVolumeSeries(const Keys& keys);

/// The segments in the order of the file, with the keys that nobody knows. What is missing has Slicer's
/// default: Layer N, LabelValue 1, Name the ID, Color DefaultColor or else grey. Ends at the first missing
/// SegmentN_ID.
/// @throws std::runtime_error naming the file and the segment: no number where one must be, layer out of
/// range,
///         label 0
std::vector<Tissue> readSegments(const std::filesystem::path& file, const Keys& keys, int layers);

/// The SegmentN_Extents of so many segments: boxes of voxels outside of which 3D Slicer crops, clamped to the
/// image. The whole image where there is none, or none that can be read.
std::vector<VoxelBox> readExtents(const Keys& keys, std::size_t segments, const Eigen::Vector3i& size);

/// The keys that are neither SegmentN_* nor rewritten for every file, to be carried through: conversion
/// parameters and what other programs left.
Keys otherKeys(const Keys& keys);

/// All keys of a segmentation file, in the order of writing. Names are unescaped.
std::vector<std::pair<std::string, std::string>> writeKeys(const Segmentation& segmentation);

}  // namespace sinew::slicer
