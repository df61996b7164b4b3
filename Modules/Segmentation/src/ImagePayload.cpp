#include "ImagePayload.h"

#include "Text.h"
#include "UnpackStream.h"

#include <algorithm>
#include <span>

namespace sinew {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kDeflateBestRatio = 1040;  // 1032:1 by its design, plus the wrapper

std::uint64_t storedBytes(const ImagePayload& payload) {
  const std::uint64_t size = fs::file_size(payload.file);
  return size > payload.offset ? size - payload.offset : 0;
}

void swapBytes(std::span<std::byte> bytes, std::size_t size) {
  for (std::size_t i = 0; i + size <= bytes.size(); i += size) std::ranges::reverse(bytes.subspan(i, size));
}

/// slope * value + intercept, as ITK does: computed in double, kept as float.
template <class Value>
void rescale(const ImagePayload& payload, std::span<const std::byte> values, std::span<float> out) {
  const auto* typed = reinterpret_cast<const Value*>(values.data());
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] =
        static_cast<float>(double{payload.slope} * static_cast<double>(typed[i]) + double{payload.intercept});
}

using Rescale = void (*)(const ImagePayload&, std::span<const std::byte>, std::span<float>);

/// In the order of ValueType.
constexpr Rescale kRescale[]{rescale<std::uint8_t>,  rescale<std::int8_t>,   rescale<std::uint16_t>,
                             rescale<std::int16_t>,  rescale<std::uint32_t>, rescale<std::int32_t>,
                             rescale<std::uint64_t>, rescale<std::int64_t>,  rescale<float>,
                             rescale<double>};

[[noreturn]] void refuseTruncated(const fs::path& file, std::uint64_t found, const ImagePayload& payload) {
  text::refuse(file, "its voxels are truncated or damaged: " + std::to_string(found) + " of " +
                         std::to_string(payload.bytes) + " bytes can be read; export the segmentation again");
}

/// The header was read twice, by Sinew and by ITK's libraries, which differ on damaged ones.
void requireSize(const fs::path& file, std::uint64_t bytes, const ImagePayload& payload) {
  if (bytes != payload.bytes)
    text::refuse(file, "its header contradicts itself: its voxels take " + std::to_string(bytes) + " or " +
                           std::to_string(payload.bytes) + " bytes; export the segmentation again");
}

}  // namespace

void requirePlausibleSize(const fs::path& file, const ImagePayload& payload) {
  const std::uint64_t stored = storedBytes(payload), wanted = payload.skip + payload.bytes;
  if ((payload.compressed ? stored * kDeflateBestRatio : stored) >= wanted) return;
  text::refuse(file,
               "its voxels are truncated: the header promises " + std::to_string(payload.bytes) +
                   " bytes, only " +
                   std::to_string(payload.compressed ? stored : stored - std::min(stored, payload.skip)) +
                   (payload.compressed ? " packed" : "") + " bytes are there; export the segmentation again");
}

std::vector<std::int32_t> readPayload(const fs::path& file, const ImageGeometry& geometry,
                                      const ImagePayload& payload) {
  constexpr std::size_t chunk = 1 << 14;  // voxels
  const std::size_t valueBytes = bytesOf(payload.type);
  const bool scaled = payload.slope != 1 || payload.intercept != 0;
  const auto voxels = static_cast<std::size_t>(geometry.voxelCount());
  requireSize(file, voxels * valueBytes, payload);
  requirePlausibleSize(file, payload);
  UnpackStream stream(payload.file, payload.offset, payload.compressed ? Packing::Wrapped : Packing::None);
  stream.skip(payload.skip);

  std::vector<std::int32_t> labels;
  labels.reserve(voxels);
  std::vector<std::byte> stored(chunk * valueBytes);
  std::vector<float> real(scaled ? chunk : 0);
  for (std::size_t first = 0; first < voxels; first += chunk) {
    const std::size_t count = std::min(chunk, voxels - first);
    const std::span bytes(stored.data(), count * valueBytes);
    const std::size_t found = stream.read(bytes);
    if (found < bytes.size()) refuseTruncated(file, first * valueBytes + found, payload);
    if (payload.swapped) swapBytes(bytes, valueBytes);
    if (scaled) kRescale[static_cast<int>(payload.type)](payload, bytes, std::span(real).first(count));
    const auto* values = scaled ? reinterpret_cast<const std::byte*>(real.data()) : stored.data();
    labels.resize(first + count);
    convertToLabels(file, geometry, scaled ? ValueType::Float32 : payload.type, values, 1, first,
                    std::span(labels).subspan(first, count));
  }
  if (!stream.endsWell())
    text::refuse(file,
                 "its voxels are damaged: their checksum is wrong or missing; export the segmentation again");
  return labels;
}

}  // namespace sinew
