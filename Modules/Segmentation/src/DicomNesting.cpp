#include "DicomNesting.h"

#include "Text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

// https://dicom.nema.org/medical/dicom/current/output/chtml/part05/chapter_7.html

namespace sinew::dicom {

namespace {

constexpr std::size_t kDeepest = 64;  // segmentations have six levels
constexpr std::uint32_t kUndefined = 0xFFFFFFFF;
constexpr std::uint64_t kNoEnd = std::numeric_limits<std::uint64_t>::max();
constexpr std::streamoff kPreamble = 132;

/// Tags as group << 16 | element.
constexpr std::uint32_t kTransferSyntax = 0x00020010, kItem = 0xFFFEE000, kItemEnd = 0xFFFEE00D,
                        kSequenceEnd = 0xFFFEE0DD, kPixelData = 0x7FE00010;

/// Walks over the elements of a file, little endian.
class Walker {
 public:
  explicit Walker(const std::filesystem::path& file) : file_(file), in_(file, std::ios::binary) {
    in_.seekg(kPreamble);
  }

  void run() {
    while (step()) {
      if (levels_.size() > kDeepest)
        text::refuse(file_,
                     "is a damaged DICOM file (its sequences lie in one another without end); export the "
                     "segmentation again");
    }
  }

 private:
  struct Level {
    std::uint64_t end;  ///< position in the file, or kNoEnd
    bool implicit;      ///< no types are written
    bool fragments;     ///< items are packed pixels
  };

  std::optional<std::uint32_t> integer(int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      const int byte = in_.get();
      if (byte < 0) return std::nullopt;
      value |= static_cast<std::uint32_t>(byte) << (8 * i);
    }
    return value;
  }

  std::optional<std::uint32_t> tag() {
    const auto group = integer(2), element = integer(2);
    if (!group || !element) return std::nullopt;
    return *group << 16 | *element;
  }

  std::uint64_t position() { return static_cast<std::uint64_t>(in_.tellg()); }

  void push(std::uint32_t length, bool implicit, bool fragments = false) {
    levels_.push_back({length == kUndefined ? kNoEnd : position() + length, implicit, fragments});
  }

  void closeEnded() {
    while (!levels_.empty() && position() >= levels_.back().end) levels_.pop_back();
  }

  /// @return false at the end, and where nothing can be made of it: DCMTK will say what it is
  bool step() {
    closeEnded();
    const auto next = tag();
    if (!next) return false;
    if (!dataset_ && *next >> 16 != 2) dataset_ = true;
    if (*next == kItem || *next == kItemEnd || *next == kSequenceEnd) return stepDelimiter(*next);
    return stepElement(*next);
  }

  bool stepDelimiter(std::uint32_t tag) {
    const auto length = integer(4);
    if (!length) return false;
    if (tag != kItem) {
      if (!levels_.empty()) levels_.pop_back();
      return true;
    }
    if (!levels_.empty() && levels_.back().fragments) return skip(*length);
    push(*length, implicit());
    return true;
  }

  bool stepElement(std::uint32_t tag) {
    std::array<char, 2> type{};
    const bool typed = !implicit();
    std::optional<std::uint32_t> length;
    if (typed) {
      in_.read(type.data(), type.size());
      length = integer(2);
      if (hasLongLength({type.data(), type.size()})) length = integer(4);
    } else {
      length = integer(4);
    }
    if (!length || !in_) return false;
    const std::string_view name(type.data(), type.size());
    if ((typed && name == "SQ") || *length == kUndefined) {
      push(*length, !typed || name == "UN", tag == kPixelData);
      return true;
    }
    if (tag == kTransferSyntax) return readTransferSyntax(*length);
    return skip(*length);
  }

  static bool hasLongLength(std::string_view type) {
    static constexpr std::array<std::string_view, 13> types{"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                            "SV", "UC", "UN", "UR", "UT", "UV"};
    return std::ranges::find(types, type) != types.end();
  }

  bool readTransferSyntax(std::uint32_t length) {
    constexpr std::uint32_t longest = 64;
    if (length > longest) return false;
    std::string uid(length, '\0');
    in_.read(uid.data(), length);
    while (uid.ends_with('\0') || uid.ends_with(' ')) uid.pop_back();
    implicitDataset_ = uid == "1.2.840.10008.1.2";
    const bool deflated = uid == "1.2.840.10008.1.2.1.99", bigEndian = uid == "1.2.840.10008.1.2.2";
    return !deflated && !bigEndian;
  }

  bool skip(std::uint32_t length) {
    in_.seekg(length, std::ios::cur);
    return in_.good();
  }

  bool implicit() const { return levels_.empty() ? dataset_ && implicitDataset_ : levels_.back().implicit; }

  const std::filesystem::path& file_;
  std::ifstream in_;
  std::vector<Level> levels_;
  bool dataset_ = false;  ///< behind the file's meta information
  bool implicitDataset_ = false;
};

}  // namespace

void requireShallowNesting(const std::filesystem::path& file) { Walker(file).run(); }

}  // namespace sinew::dicom
