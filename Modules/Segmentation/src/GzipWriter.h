#pragma once

#include <cstddef>
#include <memory>
#include <ostream>
#include <span>
#include <vector>

struct z_stream_s;

/// The door to zlib.
namespace sinew {

/// Packs bytes into one gzip member. Its header carries no time and no name: the same bytes give the same
/// file.
class GzipWriter {
 public:
  explicit GzipWriter(std::ostream& out);
  ~GzipWriter();
  GzipWriter(const GzipWriter&) = delete;
  GzipWriter& operator=(const GzipWriter&) = delete;

  void write(std::span<const std::byte> bytes);
  /// Call it once, at the end.
  void finish();

 private:
  void deflateAll(std::span<const std::byte> bytes, int flush);

  std::ostream& out_;
  std::vector<unsigned char> packed_;
  std::unique_ptr<z_stream_s> stream_;
};

}  // namespace sinew
