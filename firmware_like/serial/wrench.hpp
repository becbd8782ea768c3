// A force and a torque, of which the context says on what, about which point and in which frame.
#pragma once

#include "firmware_like/math/pose.hpp"

namespace liana::serial {

struct Wrench {
  Vec3 force_N{};
  Vec3 torque_Nm{};
};

inline Wrench sum_of(const Wrench& a, const Wrench& b) noexcept {
  return {add(a.force_N, b.force_N), add(a.torque_Nm, b.torque_Nm)};
}
inline Wrench scaled(const Wrench& a, double s) noexcept { return {scale(a.force_N, s), scale(a.torque_Nm, s)}; }
// The same in another frame about the same point; `q` turns from the frame it is in to the other.
inline Wrench turned(const Quat& q, const Wrench& a) noexcept { return {rotate(q, a.force_N), rotate(q, a.torque_Nm)}; }

}  // namespace liana::serial
