#pragma once

#include "sinew/LevelSet/DenseField.h"

#include <algorithm>
#include <cmath>

namespace sinew {

/// Neighbouring samples of one row.
struct BandRun {
  int j, first, last;  ///< row, samples first..last-1
  std::size_t offset;  ///< of the first sample among those of all runs of the slice
};

/// The samples of one slice that lie in a band.
struct BandSlice {
  std::vector<BandRun> runs;
  std::size_t samples = 0;
};

/// The samples with |phi| < within, slice by slice in raster order. Cost: O(samples), slices in parallel.
std::vector<BandSlice> bandRuns(const DenseField& phi, float within);
/// The samples with steps <= atMost.
std::vector<BandSlice> bandRuns(const DenseMask& steps, int atMost);

/// Rows j-1..j+1 of slices k-1..k+1; beyond the raster lies its outermost row.
struct RowStencil {
  const float* rows[3][3];  ///< [slice][row]

  RowStencil(const DenseField& phi, int j, int k) {
    for (int dk = 0; dk < 3; ++dk)
      for (int dj = 0; dj < 3; ++dj)
        rows[dk][dj] =
            phi.row(std::clamp(j + dj - 1, 0, phi.size.y() - 1), std::clamp(k + dk - 1, 0, phi.size.z() - 1));
  }
};

/// First and second derivatives by central differences, per sample.
struct Derivatives {
  float x, y, z;
  float xx, yy, zz, xy, xz, yz;
};

/// At sample i of the middle row, whose neighbours are `before` and `after`.
inline Derivatives derivatives(const RowStencil& s, int before, int i, int after) {
  const float *mm = s.rows[0][0], *m0 = s.rows[0][1], *mp = s.rows[0][2];
  const float *om = s.rows[1][0], *o0 = s.rows[1][1], *op = s.rows[1][2];
  const float *pm = s.rows[2][0], *p0 = s.rows[2][1], *pp = s.rows[2][2];
  const float twice = 2 * o0[i];
  return {0.5F * (o0[after] - o0[before]),
          0.5F * (op[i] - om[i]),
          0.5F * (p0[i] - m0[i]),
          o0[after] + o0[before] - twice,
          op[i] + om[i] - twice,
          p0[i] + m0[i] - twice,
          0.25F * ((op[after] - op[before]) - (om[after] - om[before])),
          0.25F * ((p0[after] - p0[before]) - (m0[after] - m0[before])),
          0.25F * ((pp[i] - pm[i]) - (mp[i] - mm[i]))};
}

}  // namespace sinew
