#include "ZlibStreams.h"

#include <algorithm>
#include <new>
#include <zlib.h>

namespace sinew {

namespace {

constexpr std::size_t kBuffer = 1 << 16;  // bytes
constexpr int kWindow = 15, kGzipWrapper = 16, kEitherWrapper = 32;

}  // namespace

bool isGzip(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return stream.get() == 0x1F && stream.get() == 0x8B;
}

UnpackStream::UnpackStream(const std::filesystem::path& file, std::uint64_t offset, bool compressed)
    : in_(file, std::ios::binary) {
  in_.seekg(static_cast<std::streamoff>(offset));
  if (!compressed) return;
  packed_.resize(kBuffer);
  stream_ = std::make_unique<z_stream>();
  if (inflateInit2(stream_.get(), kWindow + kEitherWrapper) != Z_OK) throw std::bad_alloc();
}

UnpackStream::~UnpackStream() {
  if (stream_) inflateEnd(stream_.get());
}

std::size_t UnpackStream::read(std::span<std::byte> out) {
  if (!stream_) {
    in_.read(reinterpret_cast<char*>(out.data()), static_cast<std::streamsize>(out.size()));
    return static_cast<std::size_t>(in_.gcount());
  }
  stream_->next_out = reinterpret_cast<unsigned char*>(out.data());
  stream_->avail_out = static_cast<uInt>(out.size());
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

/// @return false at the end and on damage
bool UnpackStream::inflateSome() {
  if (stream_->avail_in == 0) {
    in_.read(reinterpret_cast<char*>(packed_.data()), static_cast<std::streamsize>(packed_.size()));
    stream_->next_in = packed_.data();
    stream_->avail_in = static_cast<uInt>(in_.gcount());
    if (stream_->avail_in == 0) return false;
  }
  if (ended_) inflateReset(stream_.get());
  const int status = inflate(stream_.get(), Z_NO_FLUSH);
  ended_ = status == Z_STREAM_END;
  return status == Z_OK || ended_;
}

GzipWriter::GzipWriter(std::ostream& out)
    : out_(out), packed_(kBuffer), stream_(std::make_unique<z_stream>()) {
  constexpr int memoryLevel = 8;  // zlib's default
  if (deflateInit2(stream_.get(), Z_DEFAULT_COMPRESSION, Z_DEFLATED, kWindow + kGzipWrapper, memoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}

GzipWriter::~GzipWriter() { deflateEnd(stream_.get()); }

void GzipWriter::write(std::span<const std::byte> bytes) { deflateAll(bytes, Z_NO_FLUSH); }

void GzipWriter::finish() { deflateAll({}, Z_FINISH); }

void GzipWriter::deflateAll(std::span<const std::byte> bytes, int flush) {
  stream_->next_in =
      reinterpret_cast<unsigned char*>(const_cast<std::byte*>(bytes.data()));  // zlib only reads
  stream_->avail_in = static_cast<uInt>(bytes.size());
  do {
    stream_->next_out = packed_.data();
    stream_->avail_out = static_cast<uInt>(packed_.size());
    deflate(stream_.get(), flush);
    out_.write(reinterpret_cast<const char*>(packed_.data()),
               static_cast<std::streamsize>(packed_.size() - stream_->avail_out));
  } while (stream_->avail_out == 0);
}

}  // namespace sinew
