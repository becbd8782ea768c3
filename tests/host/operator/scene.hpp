// The slit crossing's scene for tests: slit frame and rod in the base frame (mission scene panel_slit).
#pragma once

#include <cmath>

#include "host/operator/slit_view.hpp"

namespace liana::test {

// Unit quaternion of the rotation with these columns.
inline Quat quaternion_of_columns(const Vec3& x, const Vec3& y, const Vec3& z) {
  const double w = std::sqrt(1.0 + x[0] + y[1] + z[2]) / 2.0;
  return normalize({w, (y[2] - z[1]) / (4.0 * w), (z[0] - x[2]) / (4.0 * w), (x[1] - y[0]) / (4.0 * w)});
}

inline operator_side::SlitDrawing panel_slit() {
  const Vec3 n{0.0036296, 0.9925349, -0.1219070};
  const Vec3 u{0.9999934, -0.0036025, 0.0004425};
  const Vec3 w = cross(u, n);
  const Vec3 mouth = add(scale(u, 1.75), scale(n, -0.7845031));
  const Pose slit{mouth, quaternion_of_columns(u, n, w)};
  const Pose rod{{3.392167, -0.767048, 0.291155}, normalize({0.96559342, -0.05861635, 0.25277813, -0.01722436})};
  return operator_side::slit_drawing(slit, rod);
}

}  // namespace liana::test
