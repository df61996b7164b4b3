#include "ItkImage.h"

#include "ImageFormats.h"
#include "Text.h"

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <iostream>
#include <locale.h>
#include <locale>
#include <memory>
#include <new>
#include <sstream>

namespace sinew {

namespace {

namespace fs = std::filesystem;
using ImageIO = itk::ImageIOBase;

/// While it lives, ITK and the libraries below it say nothing on the terminal: what went wrong is in the
/// exception.
class Silence {
 public:
  Silence() { itk::Object::SetGlobalWarningDisplay(false); }
  ~Silence() {
    std::cerr.rdbuf(cerr_);
    std::cout.rdbuf(cout_);
    itk::Object::SetGlobalWarningDisplay(warnings_);
  }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  bool warnings_ = itk::Object::GetGlobalWarningDisplay();
  std::ostringstream nowhere_;
  std::streambuf* cerr_ = std::cerr.rdbuf(nowhere_.rdbuf());
  std::streambuf* cout_ = std::cout.rdbuf(nowhere_.rdbuf());
};

/// While it lives, numbers have a decimal point and no thousands separators, for C's functions in this thread
/// and for new C++ streams, whatever the user's language: in Germany, NrrdIO reads 0.5 as 0, and MetaIO 10.5
/// as 10.
class PointDecimals {
 public:
  PointDecimals() {
    uselocale(plain_);
    // Setting a named locale resets C's as well: leave it alone where nothing is to do.
    if (hasCommas(before_)) std::locale::global(std::locale(before_, new std::numpunct<char>));
  }
  ~PointDecimals() {
    if (hasCommas(before_)) std::locale::global(before_);
    uselocale(beforeInC_);
    freelocale(plain_);
  }
  PointDecimals(const PointDecimals&) = delete;
  PointDecimals& operator=(const PointDecimals&) = delete;

 private:
  static bool hasCommas(const std::locale& locale) {
    const auto& numbers = std::use_facet<std::numpunct<char>>(locale);
    return numbers.decimal_point() != '.' || !numbers.grouping().empty();
  }

  std::locale before_;
  locale_t beforeInC_ = uselocale(locale_t{});
  locale_t plain_ = newlocale(LC_NUMERIC_MASK, "C", duplocale(beforeInC_));
};

/// ITK's exceptions have many lines; the last one names the cause, behind the name of a function.
std::string cause(const itk::ExceptionObject& exception) {
  std::string_view last;
  for (const std::string_view line : text::split(exception.GetDescription(), '\n'))
    if (!text::trim(line).empty()) last = text::trim(line);
  if (const auto name = last.find("): "); name != std::string_view::npos) last.remove_prefix(name + 3);
  if (last.starts_with("[nrrd] ")) last.remove_prefix(std::min(last.find(": ") + 2, last.size()));
  return text::printable(last);
}

ImageIO::Pointer createImageIO(ImageFormat format) {
  switch (format) {
    case ImageFormat::Nrrd:
      return itk::NrrdImageIO::New().GetPointer();
    case ImageFormat::Nifti:
      return itk::NiftiImageIO::New().GetPointer();
    case ImageFormat::Meta:
      break;
  }
  return itk::MetaImageIO::New().GetPointer();
}

ImageIO::Pointer openImage(const fs::path& file, ImageFormat format) {
  ImageIO::Pointer io = createImageIO(format);
  io->SetFileName(file.string());
  io->ReadImageInformation();
  return io;
}

std::vector<std::int64_t> sizes(const ImageIO& io) {
  std::vector<std::int64_t> result;
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis)
    result.push_back(static_cast<std::int64_t>(io.GetDimensions(axis)));
  return result;
}

void requireLabels(const fs::path& file, const ImageIO& io, bool list, bool layered) {
  using Pixel = itk::IOPixelEnum;
  switch (io.GetPixelType()) {
    case Pixel::SCALAR:
    case Pixel::VECTOR:
      if (io.GetNumberOfComponents() != 1 && !layered)
        refuseComponents(file, list ? "lists of values, perhaps a time series" : "vectors");
      return;
    case Pixel::RGB:
    case Pixel::RGBA:
      refuseComponents(file, "colours (RGB)");
    case Pixel::SYMMETRICSECONDRANKTENSOR:
    case Pixel::DIFFUSIONTENSOR3D:
      refuseComponents(file, "tensors");
    case Pixel::COMPLEX:
      refuseComponents(file, "complex numbers");
    default:
      refuseComponents(file, "vectors");
  }
}

/// ITK's libraries may take a damaged header for another shape than readImageHeader did.
ImageGeometry geometry(const fs::path& file, const ImageIO& io) {
  const auto shape = sizes(io);
  requireVolume(file, shape);
  volumeBytes(file, shape, 1);
  ImageGeometry result;
  for (int axis = 0; axis < 3; ++axis) {
    // As itk::ImageFileReader: a negative spacing turns its axis around.
    const double spacing = io.GetSpacing(axis), sign = spacing < 0 ? -1 : 1;
    requireSpacing(file, spacing, axis, "as ITK reads it");
    result.size[axis] = static_cast<int>(shape[axis]);
    result.spacing[axis] = sign * spacing;
    result.origin[axis] = io.GetOrigin(axis);
    const std::vector<double> direction = io.GetDirection(axis);
    result.direction.col(axis) = sign * Eigen::Vector3d(direction[0], direction[1], direction[2]);
  }
  requireDirections(file, result.direction, "as ITK reads them");
  requireOrigin(file, result.origin);
  return result;
}

ValueType valueType(const fs::path& file, const ImageIO& io) {
  using Component = itk::IOComponentEnum;
  static_assert(sizeof(long) == 8 && sizeof(int) == 4);
  switch (io.GetComponentType()) {
    case Component::UCHAR:
      return ValueType::UInt8;
    case Component::CHAR:
      return ValueType::Int8;
    case Component::USHORT:
      return ValueType::UInt16;
    case Component::SHORT:
      return ValueType::Int16;
    case Component::UINT:
      return ValueType::UInt32;
    case Component::INT:
      return ValueType::Int32;
    case Component::ULONG:
    case Component::ULONGLONG:
      return ValueType::UInt64;
    case Component::LONG:
    case Component::LONGLONG:
      return ValueType::Int64;
    case Component::FLOAT:
      return ValueType::Float32;
    case Component::DOUBLE:
      return ValueType::Float64;
    default:
      text::refuse(file, "its pixel type is unknown; save it with an integer type");
  }
}

void readVoxels(ImageIO& io, void* buffer) {
  itk::ImageIORegion region(io.GetNumberOfDimensions());
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) {
    region.SetIndex(axis, 0);
    region.SetSize(axis, io.GetDimensions(axis));
  }
  io.SetIORegion(region);
  io.Read(buffer);
}

/// Never through a scalar pixel type: the components of a voxel come side by side, and each becomes a layer.
std::vector<std::vector<std::int32_t>> readLayers(const fs::path& file, ImageIO& io,
                                                  const ImageGeometry& geometry) {
  const ValueType type = valueType(file, io);
  const std::size_t components = io.GetNumberOfComponents();
  const auto count = static_cast<std::size_t>(geometry.voxelCount());
  // Not zeroed: the pages of a size that is a lie are never touched.
  const auto voxels = std::make_unique_for_overwrite<std::byte[]>(count * components * bytesOf(type));
  readVoxels(io, voxels.get());
  std::vector<std::vector<std::int32_t>> layers;
  for (std::size_t component = 0; component < components; ++component) {
    std::vector<std::int32_t>& layer = layers.emplace_back(count);
    convertToLabels(file, geometry, type, voxels.get() + component * bytesOf(type), components, 0, layer);
  }
  return layers;
}

LabelImage readNrrd(const fs::path& file, const ImageHeader& header, bool layered) {
  if (header.payload) requirePlausibleSize(file, *header.payload);
  ImageIO::Pointer io;
  try {
    io = openImage(file, header.format);
  } catch (const itk::ExceptionObject& exception) {
    text::refuse(file, "its header cannot be read (" + cause(exception) +
                           "); correct it or export the segmentation again");
  }
  requireVolume(file, sizes(*io));  // the number of axes is told before the kind of voxels
  requireLabels(file, *io, header.list, layered);
  LabelImage image{.geometry = geometry(file, *io), .layers = {}};
  if (header.payload && io->GetNumberOfComponents() == 1) {
    image.layers.push_back(readPayload(file, image.geometry, *header.payload));
    return image;
  }
  try {
    image.layers = readLayers(file, *io, image.geometry);
  } catch (const itk::ExceptionObject& exception) {
    text::refuse(file, "its voxels are truncated or damaged (" + cause(exception) +
                           "); export the segmentation again");
  }
  return image;
}

/// ITK 5.2 refuses a NIfTI file without qform whose sform is off by more than rounding, as those of many
/// segmentation programs are, sheared, or of another scale than pixdim. The sform is still what NIfTI says.
ImageGeometry niftiOrMetaGeometry(const fs::path& file, const ImageHeader& header) {
  try {
    return geometry(file, *openImage(file, header.format));
  } catch (const itk::ExceptionObject& exception) {
    if (header.sform) return *header.sform;
    text::refuse(file, "its header cannot be read (" + cause(exception) +
                           "); correct it or export the segmentation again");
  }
}

/// MetaIO and the NIfTI library report success when voxels are missing, so the voxels are read without them.
LabelImage readNiftiOrMeta(const fs::path& file, const ImageHeader& header) {
  LabelImage image{.geometry = niftiOrMetaGeometry(file, header), .layers = {}};
  image.layers.push_back(readPayload(file, image.geometry, *header.payload));
  return image;
}

}  // namespace

LabelImage readItkImage(const fs::path& file, const ImageHeader& header, bool layered) {
  const Silence silence;
  const PointDecimals pointDecimals;
  try {
    return header.format == ImageFormat::Nrrd ? readNrrd(file, header, layered)
                                              : readNiftiOrMeta(file, header);
  } catch (const std::bad_alloc&) {
    const std::uint64_t megabytes = header.payload ? header.payload->bytes >> 20 : 0;
    text::refuse(file, "there is not enough memory to read it (its voxels take " + std::to_string(megabytes) +
                           " MB, and up to five times that as labels); crop it or use a larger machine");
  }
}

}  // namespace sinew
