#pragma once

#include <cstddef>

/// Byte offsets of NIfTI-1's fields. https://nifti.nimh.nih.gov/pub/dist/src/niftilib/nifti1.h
namespace sinew::nifti {

constexpr std::size_t kHeaderBytes = 348;

constexpr std::size_t kDim = 40, kIntentCode = 68, kDatatype = 70, kBitpix = 72, kPixdim = 76,
                      kVoxOffset = 108, kSlope = 112, kIntercept = 116, kUnits = 123, kQformCode = 252,
                      kSformCode = 254, kQuatern = 256, kSrow = 280, kMagic = 344;

}  // namespace sinew::nifti
