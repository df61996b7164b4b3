#pragma once

#include <cstddef>
#include <memory>
#include <ostream>
#include <span>
#include <vector>

struct z_stream_s;

/// The door to zlib.
namespace sinew {

/// What stands around the packed bytes.
enum class Wrapper { Gzip, Zlib };

/// Packs bytes into one gzip member or one zlib stream. Neither carries a time or a name: the same bytes give
/// the same file.
class DeflateWriter {
 public:
  DeflateWriter(std::ostream& out, Wrapper wrapper);
  ~DeflateWriter();
  DeflateWriter(const DeflateWriter&) = delete;
  DeflateWriter& operator=(const DeflateWriter&) = delete;

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
