#pragma once

#include "sinew/Segmentation/ReadSegmentation.h"
#include "sinew/TestSupport/Files.h"
#include "sinew/TestSupport/TempFolder.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>
#include <zlib.h>

/// Image files built by hand, byte by byte: an oracle for the readers that shares no code with them.
namespace sinew::test {

template <class Value>
std::string bytesOf(const std::vector<Value>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
}

/// @param windowBits  15: zlib wrapper; 31: gzip wrapper
inline std::string pack(const std::string& bytes, int windowBits) {
  z_stream stream{};
  deflateInit2(&stream, 6, Z_DEFLATED, windowBits, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&stream, bytes.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<unsigned char*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<unsigned>(bytes.size());
  stream.next_out = reinterpret_cast<unsigned char*>(packed.data());
  stream.avail_out = static_cast<unsigned>(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

inline std::string gzip(const std::string& bytes) { return pack(bytes, 31); }
inline std::string zlib(const std::string& bytes) { return pack(bytes, 15); }

/// 4 x 3 x 2 voxels with the labels 0, 1, 2 and 7.
inline std::vector<std::int32_t> smallLabels() {
  return {0, 0, 1, 1, 0, 1, 1, 0, 0, 0, 0, 7, 0, 2, 2, 0, 0, 2, 0, 0, 7, 7, 0, 0};
}

template <class Value>
std::vector<Value> smallLabelsAs() {
  const auto labels = smallLabels();
  return {labels.begin(), labels.end()};
}

struct NrrdSpec {
  std::string type = "short";
  std::string dimension = "3";
  std::string sizes = "4 3 2";
  std::string geometry =
      "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,2)\n"
      "space origin: (10,20,30)\n";
  std::string kinds = "domain domain domain";
  std::string encoding = "raw";
  std::string extra{};  ///< more lines
};

inline std::string nrrd(const NrrdSpec& spec, const std::string& data) {
  return "NRRD0004\ntype: " + spec.type + "\ndimension: " + spec.dimension + "\nsizes: " + spec.sizes + "\n" +
         spec.geometry + (spec.kinds.empty() ? "" : "kinds: " + spec.kinds + "\n") +
         "endian: little\nencoding: " + spec.encoding + "\n" + spec.extra + "\n" + data;
}

struct MetaSpec {
  std::string type = "MET_SHORT";
  std::string sizes = "4 3 2";
  std::string spacing = "1 1 2";
  std::string matrix = "1 0 0 0 1 0 0 0 1";
  std::string compressed = "False";
  std::string dataFile = "LOCAL";
  std::string extra{};  ///< more lines
};

inline std::string meta(const MetaSpec& spec, const std::string& data) {
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData "
         "= " +
         spec.compressed + "\n" + spec.extra + "TransformMatrix = " + spec.matrix +
         "\nOffset = 10 20 30\nElementSpacing = " + spec.spacing + "\nDimSize = " + spec.sizes +
         "\nElementType = " + spec.type + "\nElementDataFile = " + spec.dataFile + "\n" + data;
}

using Rows = std::array<std::array<float, 4>, 3>;

struct NiftiSpec {
  std::vector<std::int16_t> dim{4, 3, 2};
  std::int16_t datatype = 4, bitpix = 16, intent = 0;
  std::array<float, 3> pixdim{1, 1, 2};
  float slope = 1, intercept = 0;
  std::int16_t qformCode = 1;
  std::array<float, 6> qform{0, 0, 0, 10, 20, 30};  ///< quaternion b, c, d and offset
  std::int16_t sformCode = 0;
  Rows sform{};
  std::string magic{"n+1\0", 4};
};

inline std::string nifti(const NiftiSpec& spec, const std::string& data) {
  std::string header(352, '\0');
  const auto put = [&](std::size_t offset, auto value) {
    std::memcpy(&header[offset], &value, sizeof value);
  };
  put(0, std::int32_t{348});
  put(40, static_cast<std::int16_t>(spec.dim.size()));
  for (int i = 0; i < 7; ++i)
    put(42 + 2 * i, i < static_cast<int>(spec.dim.size()) ? spec.dim[i] : std::int16_t{1});
  put(68, spec.intent);
  put(70, spec.datatype);
  put(72, spec.bitpix);
  put(76, 1.0f);
  for (int i = 0; i < 7; ++i) put(80 + 4 * i, i < 3 ? spec.pixdim[i] : 1.0f);
  put(108, 352.0f);
  put(112, spec.slope);
  put(116, spec.intercept);
  put(123, char{2});  // mm
  put(252, spec.qformCode);
  put(254, spec.sformCode);
  for (int i = 0; i < 6; ++i) put(256 + 4 * i, spec.qform[i]);
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column) put(280 + 16 * row + 4 * column, spec.sform[row][column]);
  std::memcpy(&header[344], spec.magic.data(), 4);
  return header + data;
}

/// What is read from a file of this name with these bytes.
inline Segmentation segmentationFrom(const std::string& name, const std::string& bytes) {
  const TempFolder folder;
  writeBytes(folder / name, bytes);
  return readSegmentation(folder / name);
}

}  // namespace sinew::test
