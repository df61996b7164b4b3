#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <span>
#include <vector>

struct inflate_state;

/// The door to ISA-L, which unpacks several times as fast as zlib.
namespace sinew {

/// Whether a file begins as gzip files do.
bool isGzip(const std::filesystem::path& file);

/// How bytes are stored: as they are, with zlib's or gzip's wrapper (told by the content), or deflated
/// without one.
enum class Packing { None, Wrapped, Raw };

/// The bytes of a file from an offset on, unpacked on the way when they are packed; several gzip members may
/// follow each other.
class UnpackStream {
 public:
  UnpackStream(const std::filesystem::path& file, std::uint64_t offset, Packing packing);
  ~UnpackStream();
  UnpackStream(const UnpackStream&) = delete;
  UnpackStream& operator=(const UnpackStream&) = delete;

  /// Fills `out` as far as it goes.
  /// @return bytes read; fewer than wanted at the end and where the stream is damaged
  std::size_t read(std::span<std::byte> out);
  /// Passes over bytes, or what there is of them.
  void skip(std::uint64_t bytes);
  /// Whether the rest of the stream is sound up to its checksum, as far as anyone would look (1 MB).
  bool endsWell();

 private:
  bool beginMember();
  bool refill();
  void topUp();
  bool inflateSome();

  std::ifstream in_;
  std::vector<unsigned char> packed_;
  std::unique_ptr<inflate_state> stream_;  ///< empty when nothing is compressed
  unsigned wrapper_ = 0;                   ///< gzip's or zlib's, as ISA-L names them
  bool ended_ = false;                     ///< behind the checksum of a member
  bool damaged_ = false;                   ///< for good
};

}  // namespace sinew
