#include "UnpackStream.h"

#include <algorithm>
#include <array>
#include <isa-l/igzip_lib.h>

namespace sinew {

namespace {

constexpr std::size_t kBuffer = 1 << 18;  // bytes of packed input: more than a header of any sense
constexpr std::size_t kChunk = 1 << 16;   // bytes passed over at once
constexpr std::array<unsigned char, 2> kGzipMagic{0x1F, 0x8B};

}  // namespace

bool isGzip(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return stream.get() == kGzipMagic[0] && stream.get() == kGzipMagic[1];
}

UnpackStream::UnpackStream(const std::filesystem::path& file, std::uint64_t offset, Packing packing)
    : in_(file, std::ios::binary) {
  in_.seekg(static_cast<std::streamoff>(offset));
  if (packing == Packing::None) return;
  packed_.resize(kBuffer);
  stream_ = std::make_unique<inflate_state>();
  isal_inflate_init(stream_.get());
  const bool filled = refill();
  wrapper_ = packing == Packing::Raw                      ? ISAL_DEFLATE
             : filled && packed_.front() == kGzipMagic[0] ? ISAL_GZIP
                                                          : ISAL_ZLIB;
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
  if (!stream_) {
    in_.seekg(static_cast<std::streamoff>(bytes), std::ios::cur);
    return;
  }
  std::vector<std::byte> scratch(std::min<std::uint64_t>(bytes, kChunk));
  while (bytes > 0) {
    const std::size_t count = read(std::span(scratch).first(std::min<std::uint64_t>(bytes, scratch.size())));
    if (count == 0) return;
    bytes -= count;
  }
}

bool UnpackStream::endsWell() {
  if (!stream_) return true;
  std::vector<std::byte> rest(kChunk);
  for (std::size_t looked = 0; !ended_ && looked < (1 << 20); looked += rest.size())
    if (read(rest) < rest.size()) break;
  return !damaged_ && (ended_ || stream_->avail_in > 0 || in_.good());
}

/// @return whether there is packed input
bool UnpackStream::refill() {
  if (stream_->avail_in == 0) topUp();
  return stream_->avail_in > 0;
}

/// Fills the buffer behind what is left in it.
void UnpackStream::topUp() {
  std::copy_n(stream_->next_in, stream_->avail_in, packed_.data());
  stream_->next_in = packed_.data();
  in_.read(reinterpret_cast<char*>(packed_.data()) + stream_->avail_in,
           static_cast<std::streamsize>(packed_.size() - stream_->avail_in));
  stream_->avail_in += static_cast<std::uint32_t>(in_.gcount());
}

/// @return false when no further member follows; what else may follow is of no concern
bool UnpackStream::beginMember() {
  topUp();  // ISA-L 2.30 forgets where it is when a call ends within a member's header
  const unsigned char* next = stream_->next_in;
  if (wrapper_ != ISAL_GZIP || stream_->avail_in < 2 || next[0] != kGzipMagic[0] || next[1] != kGzipMagic[1])
    return false;
  isal_inflate_reset(stream_.get());
  stream_->crc_flag = wrapper_;
  return true;
}

/// @return false at the end and on damage
bool UnpackStream::inflateSome() {
  if (damaged_ || (ended_ && !beginMember())) return false;
  const bool more = refill();
  const std::uint32_t wanted = stream_->avail_out;
  damaged_ = isal_inflate(stream_.get()) != ISAL_DECOMP_OK;
  ended_ = !damaged_ && stream_->block_state == ISAL_BLOCK_FINISH;
  // Without input there may still be output in its buffer, until a call yields nothing.
  return !damaged_ && (more || ended_ || stream_->avail_out < wanted);
}

}  // namespace sinew
