#include "DeflateWriter.h"

#include <new>
#include <zlib.h>

namespace sinew {

namespace {

constexpr std::size_t kPackedBytes = 1 << 16;  // bytes
constexpr int kWindow = 15, kGzipWrapper = 16;

}  // namespace

DeflateWriter::DeflateWriter(std::ostream& out, Wrapper wrapper)
    : out_(out), packed_(kPackedBytes), stream_(std::make_unique<z_stream>()) {
  constexpr int memoryLevel = 8;  // zlib's default
  const int window = wrapper == Wrapper::Gzip ? kWindow + kGzipWrapper : kWindow;
  if (deflateInit2(stream_.get(), Z_DEFAULT_COMPRESSION, Z_DEFLATED, window, memoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
}

DeflateWriter::~DeflateWriter() { deflateEnd(stream_.get()); }

void DeflateWriter::write(std::span<const std::byte> bytes) { deflateAll(bytes, Z_NO_FLUSH); }

void DeflateWriter::finish() { deflateAll({}, Z_FINISH); }

void DeflateWriter::deflateAll(std::span<const std::byte> bytes, int flush) {
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
