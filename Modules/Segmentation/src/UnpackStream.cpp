#include "UnpackStream.h"

#include <algorithm>
#include <isa-l/igzip_lib.h>

namespace sinew {

namespace {

constexpr std::size_t kBuffer = 1 << 16;  // bytes
constexpr unsigned char kGzipMagic = 0x1F;

}  // namespace

bool isGzip(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return stream.get() == kGzipMagic && stream.get() == 0x8B;
}

UnpackStream::UnpackStream(const std::filesystem::path& file, std::uint64_t offset, bool compressed)
    : in_(file, std::ios::binary) {
  in_.seekg(static_cast<std::streamoff>(offset));
  if (!compressed) return;
  packed_.resize(kBuffer);
  stream_ = std::make_unique<inflate_state>();
  isal_inflate_init(stream_.get());
  wrapper_ = refill() && packed_.front() == kGzipMagic ? ISAL_GZIP : ISAL_ZLIB;
  stream_->crc_flag = wrapper_;
}

UnpackStream::~UnpackStream() = default;

std::size_t UnpackStream::read(std::span<std::byte> out) {
  if (!stream_) {
    in_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
    return static_cast<std::size_t>(in_.gcount());
  }
  stream_->next_out = reinterpret_cast<unsigned char*>(out.data());
  stream_->avail_out = static_cast<std::uint32_t>(out.size());
  while (stream_->avail_out > 0 && inflateSome()) {
  }
  return out.size() - stream_->avail_out;
}

void UnpackStream::skip(std::uint64_t bytes) {
  std::vector<std::byte> scratch(std::min<std::uint64_t>(bytes, kBuffer));
  while (bytes > 0) {
    const std::size_t count = read(std::span(scratch).first(std::min<std::uint64_t>(bytes, scratch.size())));
    if (count == 0) return;
    bytes -= count;
  }
}

bool UnpackStream::endsWell() {
  if (!stream_) return true;
  std::vector<std::byte> rest(kBuffer);
  for (std::size_t looked = 0; !ended_ && looked < (1 << 20); looked += rest.size())
    if (read(rest) < rest.size()) return ended_;
  return true;
}

/// @return whether there is packed input
bool UnpackStream::refill() {
  if (stream_->avail_in > 0) return true;
  in_.read(reinterpret_cast<char*>(packed_.data()), static_cast<std::streamsize>(packed_.size()));
  stream_->next_in = packed_.data();
  stream_->avail_in = static_cast<std::uint32_t>(in_.gcount());
  return stream_->avail_in > 0;
}

/// @return false at the end and on damage
bool UnpackStream::inflateSome() {
  const bool more = refill();
  if (ended_) {
    if (!more) return false;
    isal_inflate_reset(stream_.get());
    stream_->crc_flag = wrapper_;
  }
  const std::uint32_t wanted = stream_->avail_out;
  const int status = isal_inflate(stream_.get());
  ended_ = status == ISAL_DECOMP_OK && stream_->block_state == ISAL_BLOCK_FINISH;
  // Without input there may still be output in its buffer, until a call yields nothing.
  return status == ISAL_DECOMP_OK && (more || ended_ || stream_->avail_out < wanted);
}

}  // namespace sinew
