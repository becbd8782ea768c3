// Principal axes of a symmetric 3 x 3 tensor.
#pragma once

#include <array>
#include <cmath>

#include "hil/math/vec3.hpp"

namespace liana::bench {

// The tensor is rotate(attitude, diag(moment)): attitude turns the principal axes into the tensor's frame.
struct PrincipalAxes {
  std::array<double, 3> moment{};
  Quat attitude;
};

// By Jacobi's rotations, to the last digits; `tensor` is given by its columns. Six sweeps are more than enough for
// three axes.
inline PrincipalAxes principal_axes(std::array<Vec3, 3> tensor) {
  constexpr int kSweeps = 6;
  Quat attitude;
  const auto rotated = [&tensor](const Quat& q, const Vec3& v) {  // R^T T R v
    const Vec3 w = rotate(q, v);
    return rotate(conjugate(q), w.x * tensor[0] + w.y * tensor[1] + w.z * tensor[2]);
  };
  const Vec3 unit[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int turn = 0; turn < 3 * kSweeps; ++turn) {
    const Vec3 &a = unit[turn % 3], &b = unit[(turn + 1) % 3], &axis = unit[(turn + 2) % 3];
    const Vec3 of_a = rotated(attitude, a), of_b = rotated(attitude, b);
    const double apart = dot(a, of_a) - dot(b, of_b), mixed = 2.0 * dot(b, of_a);
    const double angle = 0.5 * std::atan2(std::copysign(mixed, mixed * apart), std::fabs(apart));  // the smaller turn
    attitude = attitude * from_rotation_vector(angle * axis);
  }
  PrincipalAxes out{{}, attitude};
  for (std::size_t k = 0; k < 3; ++k) out.moment[k] = dot(unit[k], rotated(attitude, unit[k]));
  return out;
}

}  // namespace liana::bench
