// Singular values of a few rows by as many columns, by one-sided Jacobi rotations (Hestenes 1958): rows are turned in
// pairs until all are orthogonal; their lengths are the singular values. Small values come out as exactly as large
// ones.
#pragma once

#include <array>
#include <cmath>
#include <utility>

#include "firmware_like/cable/arm/robot_table.hpp"

namespace liana {

using namespace cable;  // this room serves the cable arm only

// Rows of a matrix with kMaxTheta columns; unused columns are 0.
template <std::size_t Rows>
using ThetaRows = std::array<std::array<double, kMaxTheta>, Rows>;

template <std::size_t Rows>
struct Spectrum {
  std::array<double, Rows> value{};  // falling
  std::array<std::array<double, Rows>, Rows>
      axis{};  // axis[i]: unit vector in the space of the rows that value[i] belongs to
};

// Turns rows a and b by the angle (c, s).
template <std::size_t Size>
void turn(std::array<double, Size>& a, std::array<double, Size>& b, double c, double s) {
  for (std::size_t i = 0; i < Size; ++i) {
    const double old = a[i];
    a[i] = c * old - s * b[i];
    b[i] = s * old + c * b[i];
  }
}

template <std::size_t Size>
double inner_product(const std::array<double, Size>& a, const std::array<double, Size>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < Size; ++i) sum += a[i] * b[i];
  return sum;
}

// Singular values and left singular vectors; relative error about 1e-14 of each value over 1e-150. At most 30 sweeps; 6
// are usual.
template <std::size_t Rows>
Spectrum<Rows> spectrum(ThetaRows<Rows> rows) {
  Spectrum<Rows> out;
  for (std::size_t i = 0; i < Rows; ++i) out.axis[i][i] = 1.0;
  bool turned = true;
  for (int sweep = 0; sweep < 30 && turned; ++sweep) {
    turned = false;
    for (std::size_t p = 0; p + 1 < Rows; ++p) {
      for (std::size_t q = p + 1; q < Rows; ++q) {
        const double pp = inner_product(rows[p], rows[p]), qq = inner_product(rows[q], rows[q]),
                     pq = inner_product(rows[p], rows[q]);
        if (std::fabs(pq) <= 1e-14 * std::sqrt(pp * qq)) continue;
        const double zeta = (qq - pp) / (2.0 * pq);
        const double t = std::copysign(1.0, zeta) / (std::fabs(zeta) + std::sqrt(1.0 + zeta * zeta));
        const double c = 1.0 / std::sqrt(1.0 + t * t);
        turn(rows[p], rows[q], c, c * t);
        turn(out.axis[p], out.axis[q], c, c * t);
        turned = true;
      }
    }
  }
  for (std::size_t i = 0; i < Rows; ++i) out.value[i] = std::sqrt(inner_product(rows[i], rows[i]));
  for (std::size_t i = 0; i < Rows; ++i) {
    for (std::size_t k = i + 1; k < Rows; ++k) {
      if (out.value[k] <= out.value[i]) continue;
      std::swap(out.value[i], out.value[k]);
      std::swap(out.axis[i], out.axis[k]);
    }
  }
  return out;
}

}  // namespace liana
