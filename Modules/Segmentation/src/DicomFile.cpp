#include "DicomFile.h"

#include "DicomNesting.h"
#include "Text.h"

#include <algorithm>
#include <cmath>
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmiod/cielabutil.h>
#include <dcmtk/oflog/oflog.h>
#include <limits>

// https://dicom.nema.org/medical/dicom/current/output/chtml/part03/sect_A.51.html (segmentation)

namespace sinew::dicom {

namespace {

namespace fs = std::filesystem;

constexpr const char* kLabelMapStorage = "1.2.840.10008.5.1.4.1.1.66.7";  // younger than DCMTK 3.6.7

/// While it lives, DCMTK says nothing on the terminal: what went wrong is in the exception.
class Silence {
 public:
  Silence() : before_(log4cplus().getLogLevel()) { log4cplus().setLogLevel(OFLogger::OFF_LOG_LEVEL); }
  ~Silence() { log4cplus().setLogLevel(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  static dcmtk::log4cplus::Logger log4cplus() { return dcmtk::log4cplus::Logger::getRoot(); }
  dcmtk::log4cplus::LogLevel before_;
};

/// One line, without the control characters that DICOM forbids.
std::string textOf(DcmItem& item, const DcmTagKey& tag) {
  OFString value;
  item.findAndGetOFStringArray(tag, value);
  std::string line(value.c_str(), value.length());
  std::ranges::replace_if(
      line, [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
  return text::toUtf8(text::trim(line));
}

std::optional<double> realOf(DcmItem& item, const DcmTagKey& tag, unsigned long position = 0) {
  Float64 value = 0;
  if (item.findAndGetFloat64(tag, value, position).bad() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<int> integerOf(DcmItem& item, const DcmTagKey& tag, unsigned long position = 0) {
  Uint16 value = 0;
  if (item.findAndGetUint16(tag, value, position).bad()) return std::nullopt;
  return value;
}

template <int N>
std::optional<Eigen::Matrix<double, N, 1>> vectorOf(DcmItem& item, const DcmTagKey& tag) {
  Eigen::Matrix<double, N, 1> result;
  for (int i = 0; i < N; ++i) {
    const auto value = realOf(item, tag, static_cast<unsigned long>(i));
    if (!value) return std::nullopt;
    result[i] = *value;
  }
  return result;
}

/// The first item of a sequence; null when there is none.
DcmItem* itemOf(DcmItem* parent, const DcmTagKey& sequence) {
  DcmItem* item = nullptr;
  return parent && parent->findAndGetSequenceItem(sequence, item, 0).good() ? item : nullptr;
}

/// All items of a sequence, in one pass: DCMTK counts from the front for each.
std::vector<DcmItem*> itemsOf(DcmItem& parent, const DcmTagKey& tag) {
  std::vector<DcmItem*> items;
  DcmSequenceOfItems* sequence = nullptr;
  if (parent.findAndGetSequence(tag, sequence).bad() || !sequence) return items;
  for (DcmObject* object = sequence->nextInContainer(nullptr); object;
       object = sequence->nextInContainer(object))
    if (auto* item = dynamic_cast<DcmItem*>(object)) items.push_back(item);
  return items;
}

Code codeOf(DcmItem* parent, const DcmTagKey& sequence) {
  DcmItem* item = itemOf(parent, sequence);
  if (!item) return {};
  return {textOf(*item, DCM_CodingSchemeDesignator), textOf(*item, DCM_CodeValue),
          textOf(*item, DCM_CodeMeaning)};
}

/// CIE L*a*b* to sRGB, as the programs write it that make segmentations with DCMTK (white point D65).
std::optional<std::array<double, 3>> colorOf(DcmItem& item) {
  std::array<double, 3> lab{}, rgb{};
  for (std::size_t c = 0; c < lab.size(); ++c) {
    const auto value = integerOf(item, DCM_RecommendedDisplayCIELabValue, c);
    if (!value) return std::nullopt;
    lab[c] = *value;
  }
  IODCIELabUtil::dicomLab2RGB(rgb[0], rgb[1], rgb[2], lab[0], lab[1], lab[2]);
  for (double& value : rgb) value = std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.5;
  return rgb;
}

Segment segmentOf(DcmItem& item) {
  DcmItem* type = itemOf(&item, DCM_SegmentedPropertyTypeCodeSequence);
  DcmItem* region = itemOf(&item, DCM_AnatomicRegionSequence);
  return {.number = integerOf(item, DCM_SegmentNumber).value_or(-1),
          .label = textOf(item, DCM_SegmentLabel),
          .color = colorOf(item),
          .category = codeOf(&item, DCM_SegmentedPropertyCategoryCodeSequence),
          .type = codeOf(&item, DCM_SegmentedPropertyTypeCodeSequence),
          .typeModifier = codeOf(type, DCM_SegmentedPropertyTypeModifierCodeSequence),
          .region = codeOf(&item, DCM_AnatomicRegionSequence),
          .regionModifier = codeOf(region, DCM_AnatomicRegionModifierSequence)};
}

Frame frameOf(DcmItem& own, DcmItem* shared) {
  const auto group = [&](const DcmTagKey& sequence) {
    DcmItem* item = itemOf(&own, sequence);
    return item ? item : itemOf(shared, sequence);
  };
  Frame frame;
  if (DcmItem* item = group(DCM_PlanePositionSequence))
    frame.position = vectorOf<3>(*item, DCM_ImagePositionPatient);
  if (DcmItem* item = group(DCM_PlaneOrientationSequence))
    if (const auto axes = vectorOf<6>(*item, DCM_ImageOrientationPatient))
      frame.axes = {axes->template head<3>(), axes->template tail<3>()};
  if (DcmItem* item = group(DCM_PixelMeasuresSequence)) {
    if (const auto spacing = vectorOf<2>(*item, DCM_PixelSpacing))
      frame.pixelSpacing = {(*spacing)[0], (*spacing)[1]};
    frame.sliceSpacing = realOf(*item, DCM_SpacingBetweenSlices);
    if (!frame.sliceSpacing) frame.sliceSpacing = realOf(*item, DCM_SliceThickness);
  }
  if (DcmItem* item = group(DCM_SegmentIdentificationSequence))
    frame.segment = integerOf(*item, DCM_ReferencedSegmentNumber);
  return frame;
}

void requireSegmentation(const fs::path& file, DcmDataset& dataset) {
  const std::string uid = textOf(dataset, DCM_SOPClassUID);
  if (uid == UID_SegmentationStorage || uid == kLabelMapStorage) return;
  const char* name = dcmFindNameOfUID(uid.c_str(), nullptr);
  text::refuse(file, "is a DICOM object of another kind (" + text::printable(name ? name : uid) +
                         "), no segmentation; name the DICOM SEG file, or open it in 3D Slicer and export a "
                         "segmentation (.seg.nrrd)");
}

Kind kindOf(const fs::path& file, DcmDataset& dataset) {
  const std::string type = textOf(dataset, DCM_SegmentationType);
  if (type == "BINARY") return Kind::Binary;
  if (type == "FRACTIONAL") return Kind::Fractional;
  if (type == "LABELMAP") return Kind::LabelMap;
  text::refuse(file, "its DICOM SegmentationType is `" + text::printable(type) +
                         "`; BINARY, FRACTIONAL and LABELMAP can be read");
}

/// Uncompressed pixels, whatever they were stored as.
void unpackPixels(const fs::path& file, DcmDataset& dataset) {
  DcmRLEDecoderRegistration::registerCodecs();
  const OFCondition unpacked = dataset.chooseRepresentation(EXS_LittleEndianExplicit, nullptr);
  if (unpacked.bad() || !dataset.canWriteXfer(EXS_LittleEndianExplicit))
    text::refuse(file,
                 "its pixels are compressed (" +
                     text::printable(DcmXfer(dataset.getOriginalXfer()).getXferName()) +
                     "), which cannot be undone here; save it uncompressed (dcmdrle, dcmdjpls, dcmdjpeg)");
}

/// Run-length encoding packs 128 equal bytes into two, at best.
constexpr std::uintmax_t kRleBestRatio = 64;

void requirePlausiblePixels(const fs::path& file, DcmDataset& dataset, std::uintmax_t wanted) {
  const bool inflated = dataset.getOriginalXfer() == EXS_DeflatedLittleEndianExplicit;
  if (inflated || wanted / kRleBestRatio <= fs::file_size(file)) return;
  text::refuse(file, "its pixels are truncated: it promises " + std::to_string(wanted) +
                         " bytes; export the segmentation again");
}

std::vector<std::uint8_t> pixelsOf(const fs::path& file, DcmDataset& dataset, std::uintmax_t wanted) {
  requirePlausiblePixels(file, dataset, wanted);
  unpackPixels(file, dataset);
  DcmElement* element = nullptr;
  dataset.findAndGetElement(DCM_PixelData, element);
  const std::uintmax_t found = element ? element->getLengthField() : 0;
  if (found < wanted || wanted > std::numeric_limits<Uint32>::max())
    text::refuse(file, "its pixels are truncated: it promises " + std::to_string(wanted) + " bytes, " +
                           std::to_string(found) + " are there; export the segmentation again");
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(wanted + wanted % 2));
  if (element->getPartialValue(pixels.data(), 0, static_cast<Uint32>(wanted), nullptr, EBO_LittleEndian)
          .bad())
    text::refuse(file, "its pixels cannot be read; export the segmentation again");
  return pixels;
}

void readImage(const fs::path& file, DcmDataset& dataset, File& result) {
  result.rows = integerOf(dataset, DCM_Rows).value_or(0);
  result.columns = integerOf(dataset, DCM_Columns).value_or(0);
  result.bits = integerOf(dataset, DCM_BitsAllocated).value_or(0);
  result.maximumFraction = integerOf(dataset, DCM_MaximumFractionalValue).value_or(255);
  result.padding = integerOf(dataset, DCM_PixelPaddingValue);
  if (result.rows < 1 || result.columns < 1)
    text::refuse(file, "its frames have no rows or no columns; export the segmentation again");
  const bool sound = result.kind == Kind::Binary       ? result.bits == 1
                     : result.kind == Kind::Fractional ? result.bits == 8
                                                       : result.bits == 8 || result.bits == 16;
  if (!sound || integerOf(dataset, DCM_SamplesPerPixel).value_or(1) != 1)
    text::refuse(file, "its pixels have " + std::to_string(result.bits) +
                           " bits, which its SegmentationType does not allow; export the segmentation again");
}

void readFrames(const fs::path& file, DcmDataset& dataset, File& result) {
  DcmItem* shared = itemOf(&dataset, DCM_SharedFunctionalGroupsSequence);
  for (DcmItem* item : itemsOf(dataset, DCM_PerFrameFunctionalGroupsSequence))
    result.frames.push_back(frameOf(*item, shared));
  const std::string promised = textOf(dataset, DCM_NumberOfFrames);
  if (result.frames.empty() || promised != std::to_string(result.frames.size()))
    text::refuse(file, "it promises `" + text::printable(promised) + "` frames and describes " +
                           std::to_string(result.frames.size()) + "; export the segmentation again");
}

}  // namespace

File readFile(const fs::path& file) {
  const Silence silence;
  requireShallowNesting(file);
  DcmFileFormat format;
  if (const OFCondition loaded = format.loadFile(file.c_str()); loaded.bad())
    text::refuse(
        file, std::string("is a damaged DICOM file (") + loaded.text() + "); export the segmentation again");
  DcmDataset& dataset = *format.getDataset();
  requireSegmentation(file, dataset);
  static_cast<void>(dataset.convertToUTF8());  // what has no known character set is taken as it is
  File result;
  result.kind = kindOf(file, dataset);
  readImage(file, dataset, result);
  readFrames(file, dataset, result);
  for (DcmItem* item : itemsOf(dataset, DCM_SegmentSequence)) result.segments.push_back(segmentOf(*item));
  const std::uintmax_t bits = std::uintmax_t{result.framePixels()} * result.frames.size() * result.bits;
  result.pixels = pixelsOf(file, dataset, (bits + 7) / 8);
  return result;
}

}  // namespace sinew::dicom
