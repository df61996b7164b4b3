#pragma once

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

/// DICOM segmentations built element by element: small inputs for the reader that need no data from
/// elsewhere.
namespace sinew::test {

struct DicomSegmentSpec {
  int number = 1;
  std::string label = "bone";
  std::array<Uint16, 3> lab{34885, 53485, 50171};  ///< red: sRGB (1, 0, 0) has L*a*b* = 53.2, 80.1, 67.2
};

struct DicomFrameSpec {
  int segment = 1;
  int slice = 0;
  std::vector<int> pixels;  ///< row by row
};

struct DicomSpec {
  std::string sopClass = UID_SegmentationStorage;
  std::string type = "BINARY";
  int rows = 3, columns = 4, bits = 1;
  Eigen::Vector3d row{1, 0, 0}, column{0, 1, 0}, step{0, 0, 2}, origin{10, 20, 30};  ///< mm
  std::array<double, 2> pixelSpacing{0.7, 0.5};  ///< between rows, columns
  std::string sliceSpacing = "2";
  std::vector<DicomSegmentSpec> segments{{}};
  std::vector<DicomFrameSpec> frames{};
  std::function<void(DcmDataset&)> change{};  ///< the last word
  E_TransferSyntax syntax = EXS_LittleEndianExplicit;
};

/// Masks of a frame: kB lies apart from kA, kC overlaps both.
inline const std::vector<int> kA{0, 1, 1, 0, 1, 1, 0, 0, 0, 0, 0, 1};
inline const std::vector<int> kB{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0};
inline const std::vector<int> kC{0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0};

/// A mask painted with a label.
inline std::vector<std::int32_t> times(const std::vector<int>& mask, int label) {
  std::vector<std::int32_t> result;
  for (const int value : mask) result.push_back(value * label);
  return result;
}

inline DicomSpec oneFrame() { return {.frames = {{.segment = 1, .slice = 0, .pixels = kA}}}; }

/// Two frames of a label map: kA with label 7 ("fat"), and kB with 1.
inline DicomSpec labelMap(int bits) {
  DicomSpec spec{.sopClass = "1.2.840.10008.5.1.4.1.1.66.7", .type = "LABELMAP", .bits = bits};
  spec.segments = {{.number = 0, .label = "background"}, {.number = 1}, {.number = 7, .label = "fat"}};
  spec.frames = {{0, 0, times(kA, 7)}, {0, 1, times(kB, 1)}};
  return spec;
}

inline std::string decimals(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    char number[17];
    OFStandard::ftoa(number, sizeof number, value, 0, 0, 10);
    text.append(text.empty() ? "" : "\\").append(number);
  }
  return text;
}

inline void put(DcmItem& item, const DcmTagKey& tag, const std::string& value) {
  if (item.putAndInsertString(tag, value.c_str()).bad()) throw std::logic_error("DicomBuilder: " + value);
}

inline void put(DcmItem& item, const DcmTagKey& tag, int value) {
  if (item.putAndInsertUint16(tag, static_cast<Uint16>(value)).bad()) throw std::logic_error("DicomBuilder");
}

/// A new item at the end of a sequence.
inline DcmItem& add(DcmItem& parent, const DcmTagKey& sequence) {
  DcmItem* item = nullptr;
  if (parent.findOrCreateSequenceItem(sequence, item, -2).bad())
    throw std::logic_error("DicomBuilder: sequence");
  return *item;
}

inline void putCode(DcmItem& parent, const DcmTagKey& sequence, const std::string& value,
                    const std::string& meaning) {
  DcmItem& code = add(parent, sequence);
  put(code, DCM_CodeValue, value);
  put(code, DCM_CodingSchemeDesignator, "SCT");
  put(code, DCM_CodeMeaning, meaning);
}

inline void putSegment(DcmDataset& dataset, const DicomSegmentSpec& spec) {
  DcmItem& item = add(dataset, DCM_SegmentSequence);
  put(item, DCM_SegmentNumber, spec.number);
  put(item, DCM_SegmentLabel, spec.label);
  item.putAndInsertUint16Array(DCM_RecommendedDisplayCIELabValue, spec.lab.data(), 3);
  putCode(item, DCM_SegmentedPropertyCategoryCodeSequence, "123037004", "Anatomical Structure");
  putCode(item, DCM_SegmentedPropertyTypeCodeSequence, "64033007", "Kidney");
  DcmItem* type = nullptr;
  item.findAndGetSequenceItem(DCM_SegmentedPropertyTypeCodeSequence, type);
  putCode(*type, DCM_SegmentedPropertyTypeModifierCodeSequence, "7771000", "Left");
}

inline void putFrame(DcmDataset& dataset, const DicomSpec& spec, const DicomFrameSpec& frame) {
  DcmItem& item = add(dataset, DCM_PerFrameFunctionalGroupsSequence);
  const Eigen::Vector3d position = spec.origin + frame.slice * spec.step;
  put(add(item, DCM_PlanePositionSequence), DCM_ImagePositionPatient,
      decimals({position.x(), position.y(), position.z()}));
  if (spec.type != "LABELMAP")
    put(add(item, DCM_SegmentIdentificationSequence), DCM_ReferencedSegmentNumber, frame.segment);
}

/// The pixels of all frames, bits from the lowest up.
inline std::vector<Uint8> packedPixels(const DicomSpec& spec) {
  std::vector<Uint8> bytes;
  std::size_t bit = 0;
  for (const DicomFrameSpec& frame : spec.frames)
    for (const int value : frame.pixels) {
      bytes.resize((bit + spec.bits + 7) / 8, 0);
      for (int b = 0; b < spec.bits; ++b, ++bit)
        bytes[bit / 8] = static_cast<Uint8>(bytes[bit / 8] | (value >> b & 1) << bit % 8);
    }
  bytes.resize((bytes.size() + 1) / 2 * 2, 0);
  return bytes;
}

inline void putPixels(DcmDataset& dataset, const DicomSpec& spec) {
  std::vector<Uint8> bytes = packedPixels(spec);
  if (spec.bits == 16)
    dataset.putAndInsertUint16Array(DCM_PixelData, reinterpret_cast<Uint16*>(bytes.data()), bytes.size() / 2);
  else
    dataset.putAndInsertUint8Array(DCM_PixelData, bytes.data(), bytes.size());
}

inline void writeDicom(const std::filesystem::path& file, const DicomSpec& spec) {
  DcmFileFormat format;
  DcmDataset& dataset = *format.getDataset();
  put(dataset, DCM_SpecificCharacterSet, "ISO_IR 192");
  put(dataset, DCM_SOPClassUID, spec.sopClass);
  put(dataset, DCM_SOPInstanceUID, "1.2.3.4");
  put(dataset, DCM_SegmentationType, spec.type);
  put(dataset, DCM_SamplesPerPixel, 1);
  put(dataset, DCM_PhotometricInterpretation, "MONOCHROME2");
  put(dataset, DCM_NumberOfFrames, std::to_string(spec.frames.size()));
  put(dataset, DCM_Rows, spec.rows);
  put(dataset, DCM_Columns, spec.columns);
  put(dataset, DCM_BitsAllocated, spec.bits);
  put(dataset, DCM_BitsStored, spec.bits);
  put(dataset, DCM_HighBit, spec.bits - 1);
  put(dataset, DCM_PixelRepresentation, 0);
  if (spec.type == "FRACTIONAL") put(dataset, DCM_MaximumFractionalValue, 200);
  for (const DicomSegmentSpec& segment : spec.segments) putSegment(dataset, segment);
  DcmItem& shared = add(dataset, DCM_SharedFunctionalGroupsSequence);
  put(add(shared, DCM_PlaneOrientationSequence), DCM_ImageOrientationPatient,
      decimals(
          {spec.row.x(), spec.row.y(), spec.row.z(), spec.column.x(), spec.column.y(), spec.column.z()}));
  DcmItem& measures = add(shared, DCM_PixelMeasuresSequence);
  put(measures, DCM_PixelSpacing, decimals({spec.pixelSpacing[0], spec.pixelSpacing[1]}));
  if (!spec.sliceSpacing.empty()) put(measures, DCM_SpacingBetweenSlices, spec.sliceSpacing);
  for (const DicomFrameSpec& frame : spec.frames) putFrame(dataset, spec, frame);
  putPixels(dataset, spec);
  if (spec.change) spec.change(dataset);
  DcmRLEEncoderRegistration::registerCodecs();
  if (dataset.chooseRepresentation(spec.syntax, nullptr).bad() ||
      format.saveFile(file.c_str(), spec.syntax, EET_UndefinedLength).bad())
    throw std::logic_error("DicomBuilder: cannot save");
}

}  // namespace sinew::test
