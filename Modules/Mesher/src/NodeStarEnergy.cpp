#include "NodeStarEnergy.h"

#include "sinew/Mesher/VectorClones.h"

namespace sinew {

using Eigen::Vector3d;

namespace {

/// The coefficients of a star, one array each.
struct Rows {
  const double* __restrict nx, * __restrict ny, * __restrict nz, * __restrict v;
  const double* __restrict sx, * __restrict sy, * __restrict sz, * __restrict l;
  std::size_t tets;
};

/// F^(2^squarings).
inline double raise(double F, int squarings) {
  for (int s = 0; s < squarings; ++s) F *= F;
  return F;
}

template <int kSquarings>
inline StarValue sumValues(const Rows& r, double x, double y, double z) {
  const double threeD2 = 3 * (x * x + y * y + z * z);
  double energy = 0, worst = 0, flattest = kInfinity;
#pragma omp simd reduction(+ : energy) reduction(max : worst) reduction(min : flattest)
  for (std::size_t t = 0; t < r.tets; ++t) {
    const double volume6 = r.v[t] + r.nx[t] * x + r.ny[t] * y + r.nz[t] * z;
    const double L = r.l[t] - 2 * (r.sx[t] * x + r.sy[t] * y + r.sz[t] * z) + threeD2;
    const double F = L * L * L / (432 * volume6 * volume6);
    energy += raise(F, kSquarings);
    worst = F > worst ? F : worst;
    flattest = volume6 < flattest ? volume6 : flattest;
  }
  if (!(flattest > 0)) return {kInfinity, kInfinity};
  return {energy, worst};
}

/// Sums over the tets of a star, weights included.
struct Sums {
  double energy = 0, diagonal = 0;
  double gx = 0, gy = 0, gz = 0;
  double hxx = 0, hxy = 0, hxz = 0, hyy = 0, hyz = 0, hzz = 0;
};

//     ln F = 3 ln L - 2 ln(6V) + const,   g = grad ln F = 3 grad L / L - 2 n / (6V),   grad L = -2 s at d = 0
//     H = hess ln F = 18 I / L - 3 grad L grad L^T / L^2 + 2 n n^T / (6V)^2
//     grad F^q = q F^q g,   hess F^q = q F^q (H + q g g^T)
template <int kSquarings>
inline Sums sumDerivatives(const Rows& r) {
  constexpr double q = 1 << kSquarings;
  double energy = 0, diagonal = 0;
  double gx = 0, gy = 0, gz = 0;
  double hxx = 0, hxy = 0, hxz = 0, hyy = 0, hyz = 0, hzz = 0;
#pragma omp simd reduction(+ : energy, diagonal, gx, gy, gz, hxx, hxy, hxz, hyy, hyz, hzz)
  for (std::size_t t = 0; t < r.tets; ++t) {
    const double L = r.l[t], inverseL = 1 / L, inverseV = 1 / r.v[t];
    const double Fq = raise(L * L * L * inverseV * inverseV / 432, kSquarings);
    const double toU = -2 * inverseL;
    const double ux = toU * r.sx[t], uy = toU * r.sy[t], uz = toU * r.sz[t];  // grad L / L
    const double vx = inverseV * r.nx[t], vy = inverseV * r.ny[t], vz = inverseV * r.nz[t];
    const double px = 3 * ux - 2 * vx, py = 3 * uy - 2 * vy, pz = 3 * uz - 2 * vz;  // g
    const double weight = q * Fq, wg = weight * q, wu = -3 * weight, wv = 2 * weight;
    energy += Fq;
    diagonal += 18 * weight * inverseL;
    gx += weight * px;
    gy += weight * py;
    gz += weight * pz;
    hxx += wg * px * px + wu * ux * ux + wv * vx * vx;
    hxy += wg * px * py + wu * ux * uy + wv * vx * vy;
    hxz += wg * px * pz + wu * ux * uz + wv * vx * vz;
    hyy += wg * py * py + wu * uy * uy + wv * vy * vy;
    hyz += wg * py * pz + wu * uy * uz + wv * vy * vz;
    hzz += wg * pz * pz + wu * uz * uz + wv * vz * vz;
  }
  return {energy, diagonal, gx, gy, gz, hxx, hxy, hxz, hyy, hyz, hzz};
}

SINEW_VECTOR_CLONES StarValue valueOf(const Rows& r, double x, double y, double z, int q) {
  switch (q) {
    case 1:
      return sumValues<0>(r, x, y, z);
    case 2:
      return sumValues<1>(r, x, y, z);
    case 4:
      return sumValues<2>(r, x, y, z);
    case 8:
      return sumValues<3>(r, x, y, z);
    default:
      return sumValues<4>(r, x, y, z);
  }
}

SINEW_VECTOR_CLONES Sums derivativesOf(const Rows& r, int q) {
  switch (q) {
    case 1:
      return sumDerivatives<0>(r);
    case 2:
      return sumDerivatives<1>(r);
    case 4:
      return sumDerivatives<2>(r);
    case 8:
      return sumDerivatives<3>(r);
    default:
      return sumDerivatives<4>(r);
  }
}

/// From the rows a, b, c (x, y, z each) to the rows nx ... l, tet by tet.
SINEW_VECTOR_CLONES void fillCoefficients(const double* __restrict corners, std::size_t stride,
                                          std::size_t tets, double x, double y, double z,
                                          double* __restrict out) {
#pragma omp simd
  for (std::size_t t = 0; t < tets; ++t) {
    const double* in = corners + t;
    const double ax = in[0] - x, ay = in[stride] - y, az = in[2 * stride] - z;
    const double bx = in[3 * stride] - x, by = in[4 * stride] - y, bz = in[5 * stride] - z;
    const double cx = in[6 * stride] - x, cy = in[7 * stride] - y, cz = in[8 * stride] - z;
    const double ux = bx - ax, uy = by - ay, uz = bz - az;
    const double wx = cx - ax, wy = cy - ay, wz = cz - az;
    const double ex = cx - bx, ey = cy - by, ez = cz - bz;
    const double nx = uy * wz - uz * wy, ny = uz * wx - ux * wz, nz = ux * wy - uy * wx;
    double* to = out + t;
    to[0] = nx;
    to[stride] = ny;
    to[2 * stride] = nz;
    to[3 * stride] = -(ax * nx + ay * ny + az * nz);
    to[4 * stride] = ax + bx + cx;
    to[5 * stride] = ay + by + cy;
    to[6 * stride] = az + bz + cz;
    to[7 * stride] = ux * ux + uy * uy + uz * uz + wx * wx + wy * wy + wz * wz + ex * ex + ey * ey + ez * ez +
                     ax * ax + ay * ay + az * az + bx * bx + by * by + bz * bz + cx * cx + cy * cy + cz * cz;
  }
}

}  // namespace

void gatherCorners(std::span<const StarFaceNodes> faces, const std::vector<Vector3d>& nodes,
                   std::size_t rowLength, double* rows) {
  for (std::size_t t = 0; t < faces.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vector3d& node = nodes[static_cast<std::size_t>(faces[t][corner])];
      for (std::size_t axis = 0; axis < 3; ++axis)
        rows[(3 * corner + axis) * rowLength + t] = node[static_cast<Eigen::Index>(axis)];
    }
  }
}

void NodeStar::gather(std::span<const StarFaceNodes> faces, const std::vector<Vector3d>& nodes,
                      const Vector3d& origin) {
  origin_ = origin;
  tets_ = faces.size();
  if (capacity_ < tets_) {
    capacity_ = tets_;
    rows_.resize(capacity_ * kRows);
  }
  gatherCorners(faces, nodes, capacity_, row(kCorners));
  fillCoefficients(row(kCorners), capacity_, tets_, origin.x(), origin.y(), origin.z(), row(kNx));
}

StarValue NodeStar::value(const Vector3d& x, int q) const {
  const Vector3d d = x - origin_;
  const Rows rows{row(kNx), row(kNy), row(kNz), row(kV), row(kSx), row(kSy), row(kSz), row(kL), tets_};
  return valueOf(rows, d.x(), d.y(), d.z(), q);
}

StarDerivatives NodeStar::derivatives(int q) const {
  const Rows rows{row(kNx), row(kNy), row(kNz), row(kV), row(kSx), row(kSy), row(kSz), row(kL), tets_};
  const Sums s = derivativesOf(rows, q);
  StarDerivatives d;
  d.energy = s.energy;
  d.gradient = {s.gx, s.gy, s.gz};
  d.hessian << s.hxx + s.diagonal, s.hxy, s.hxz, s.hxy, s.hyy + s.diagonal, s.hyz, s.hxz, s.hyz,
      s.hzz + s.diagonal;
  return d;
}

}  // namespace sinew
