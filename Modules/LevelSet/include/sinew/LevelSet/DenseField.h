#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sinew {

/// A box of samples on a regular grid, x fastest. Where the samples lie is the owner's business.
template <typename T>
struct DenseRaster {
  Eigen::Vector3i size = Eigen::Vector3i::Zero();  ///< samples along each axis
  std::vector<T> values;                           ///< [i + size.x * (j + size.y * k)]

  DenseRaster() = default;
  explicit DenseRaster(const Eigen::Vector3i& extent, T fill = T{})
      : size(extent), values(volume(extent), fill) {}

  std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(size.x()) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(size.y()) * static_cast<std::size_t>(k));
  }
  T& operator()(int i, int j, int k) { return values[index(i, j, k)]; }
  const T& operator()(int i, int j, int k) const { return values[index(i, j, k)]; }
  T* row(int j, int k) { return values.data() + index(0, j, k); }
  const T* row(int j, int k) const { return values.data() + index(0, j, k); }

 private:
  static std::size_t volume(const Eigen::Vector3i& extent) {
    return static_cast<std::size_t>(extent.x()) * static_cast<std::size_t>(extent.y()) *
           static_cast<std::size_t>(extent.z());
  }
};

using DenseField = DenseRaster<float>;
using DenseMask = DenseRaster<std::uint8_t>;

}  // namespace sinew
