#include "TextWriter.h"

#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace sinew {

TextWriter::TextWriter(const std::filesystem::path& file) : stream_(file, std::ios::binary) {
  if (!stream_) throw std::runtime_error(std::generic_category().message(errno));
  buffer_.reserve(kFull + kFull / 8);
}

void TextWriter::flush() {
  stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
}

void TextWriter::finish() {
  flush();
  stream_.close();
  if (!stream_) throw std::runtime_error("the file is incomplete; is the disk full?");
}

}  // namespace sinew
