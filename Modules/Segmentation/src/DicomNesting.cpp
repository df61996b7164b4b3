#include "DicomNesting.h"

#include "Text.h"
#include "UnpackStream.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// https://dicom.nema.org/medical/dicom/current/output/chtml/part05/chapter_7.html

namespace sinew::dicom {

namespace {

constexpr std::size_t kDeepest = 64;  // segmentations have six levels
constexpr std::uint32_t kUndefined = 0xFFFFFFFF;
constexpr std::uint64_t kNoEnd = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kPreamble = 132;  // bytes before the meta information

/// Tags as group << 16 | element.
constexpr std::uint32_t kMetaLength = 0x00020000, kTransferSyntax = 0x00020010, kItem = 0xFFFEE000,
                        kItemEnd = 0xFFFEE00D, kSequenceEnd = 0xFFFEE0DD, kPixelData = 0x7FE00010;

/// How a dataset is written.
struct Syntax {
  bool implicit = false;  ///< without types
  bool bigEndian = false;
  Packing packing = Packing::None;
};

Syntax syntaxOf(std::string_view uid) {
  return {.implicit = uid == "1.2.840.10008.1.2",
          .bigEndian = uid == "1.2.840.10008.1.2.2",
          .packing = uid == "1.2.840.10008.1.2.1.99" ? Packing::Raw : Packing::None};
}

/// Walks over the elements from a place in a file on.
class Walker {
 public:
  Walker(const std::filesystem::path& file, std::uint64_t begin, const Syntax& syntax)
      : file_(file), in_(file, begin, syntax.packing), syntax_(syntax) {}

  struct Element {
    std::uint32_t tag;
    std::uint32_t length;
  };

  /// The next element with a value; enters sequences and items.
  /// @return nothing at the end, and where nothing can be made of it: DCMTK will say what it is
  std::optional<Element> next() {
    while (true) {
      closeEnded();
      const auto element = head();
      if (!element) return std::nullopt;
      if (!enters(*element)) return element;
      if (levels_.size() > kDeepest)
        text::refuse(file_,
                     "is a damaged DICOM file (its sequences lie in one another without end); export the "
                     "segmentation again");
    }
  }

  void skip(std::uint32_t bytes) {
    in_.skip(bytes);
    position_ += bytes;
  }

  std::string text(std::uint32_t bytes) {
    std::string value(bytes, '\0');
    value.resize(in_.read(std::as_writable_bytes(std::span(value))));
    position_ += bytes;
    return value;
  }

  std::optional<std::uint32_t> integer(std::size_t bytes) {
    std::array<std::byte, 4> raw{};
    if (in_.read(std::span(raw).first(bytes)) < bytes) return std::nullopt;
    position_ += bytes;
    if (syntax_.bigEndian) std::reverse(raw.begin(), raw.begin() + static_cast<std::ptrdiff_t>(bytes));
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) value |= std::to_integer<std::uint32_t>(raw[i]) << (8 * i);
    return value;
  }

  std::uint64_t position() const { return position_; }

 private:
  struct Level {
    std::uint64_t end;  ///< position, or kNoEnd
    bool implicit;
    bool fragments;  ///< items are packed pixels
  };

  static bool isDelimiter(std::uint32_t tag) {
    return tag == kItem || tag == kItemEnd || tag == kSequenceEnd;
  }

  static bool hasLongLength(std::string_view type) {
    static constexpr std::array<std::string_view, 13> types{"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                            "SV", "UC", "UN", "UR", "UT", "UV"};
    return std::ranges::find(types, type) != types.end();
  }

  bool implicit() const { return levels_.empty() ? syntax_.implicit : levels_.back().implicit; }

  void closeEnded() {
    while (!levels_.empty() && position_ >= levels_.back().end) levels_.pop_back();
  }

  /// Tag, type and length.
  std::optional<Element> head() {
    const auto group = integer(2), element = integer(2);
    if (!group || !element) return std::nullopt;
    const std::uint32_t tag = *group << 16 | *element;
    type_.clear();
    if (implicit() || isDelimiter(tag)) {
      const auto length = integer(4);
      return length ? std::optional(Element{tag, *length}) : std::nullopt;
    }
    type_ = text(2);
    auto length = integer(2);
    if (hasLongLength(type_)) length = integer(4);
    return length ? std::optional(Element{tag, *length}) : std::nullopt;
  }

  /// Follows the structure.
  /// @return whether the element was a part of it
  bool enters(const Element& element) {
    if (element.tag == kItemEnd || element.tag == kSequenceEnd) {
      if (!levels_.empty()) levels_.pop_back();
      return true;
    }
    const bool sequence = type_ == "SQ" || element.length == kUndefined;
    const bool fragment = !levels_.empty() && levels_.back().fragments;
    if (element.tag == kItem ? fragment : !sequence) return false;
    const bool untyped = element.tag == kItem ? implicit() : implicit() || type_ == "UN";
    levels_.push_back({element.length == kUndefined ? kNoEnd : position_ + element.length, untyped,
                       element.tag == kPixelData});
    return true;
  }

  const std::filesystem::path& file_;
  UnpackStream in_;
  Syntax syntax_;
  std::uint64_t position_ = 0;  ///< from where it began
  std::vector<Level> levels_;
  std::string type_;  ///< of the last element; empty where none is written
};

struct Dataset {
  std::uint64_t begin;
  Syntax syntax;
};

/// What the meta information says of the dataset behind it.
std::optional<Dataset> findDataset(const std::filesystem::path& file) {
  constexpr std::uint32_t longestUid = 64;
  Walker meta(file, kPreamble, {});
  std::optional<std::uint64_t> end;
  Syntax syntax;
  while (!end || meta.position() < *end) {
    const auto element = meta.next();
    if (!element) return std::nullopt;
    if (element->tag == kMetaLength && element->length == 4) {
      const auto bytes = meta.integer(4);
      if (!bytes) return std::nullopt;
      end = meta.position() + *bytes;
    } else if (element->tag == kTransferSyntax && element->length <= longestUid) {
      std::string uid = meta.text(element->length);
      while (uid.ends_with('\0') || uid.ends_with(' ')) uid.pop_back();
      syntax = syntaxOf(uid);
    } else {
      meta.skip(element->length);
    }
  }
  return Dataset{kPreamble + *end, syntax};
}

}  // namespace

void requireShallowNesting(const std::filesystem::path& file) {
  const auto dataset = findDataset(file);
  if (!dataset) return;
  Walker walker(file, dataset->begin, dataset->syntax);
  while (const auto element = walker.next()) walker.skip(element->length);
}

}  // namespace sinew::dicom
