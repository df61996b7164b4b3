#pragma once

#include <cstdint>
#include <vector>

namespace sinew {

/// Pieces and surface of a body on the body-centred cubic split of a grid, fed slice by slice; see
/// levelSetTopology.
class BccTopology {
 public:
  /// @param nx,ny  samples of a slice; the body stays clear of the outermost two
  BccTopology(int nx, int ny);

  /// Takes the next slice of values, negative inside, x fastest. The first and the last three hold none of
  /// the body.
  void addSlice(const float* phi);

  std::int64_t components() const;
  std::int64_t eulerCharacteristic() const { return euler_; }

 private:
  /// A slice of samples, or the layer of cell centres between two slices.
  struct Slice {
    std::vector<std::uint8_t> inside;
    std::vector<std::int32_t> piece;  ///< union-find node, where inside
  };

  void labelSlice(const float* phi);
  void labelLayer(const float* below, const float* above);
  void countLayer();
  int cellEuler(int at) const;
  std::int32_t find(std::int32_t node) const;
  void join(std::int32_t a, std::int32_t b);

  int nx_, ny_;
  std::int64_t euler_ = 0;
  std::vector<float> previous_;
  Slice below_, above_;  ///< the last two slices
  Slice belowLower_;     ///< the slice before them
  Slice lower_, upper_;  ///< centres between belowLower_ and below_, and between below_ and above_
  mutable std::vector<std::int32_t> parent_;
};

}  // namespace sinew
