// One number for each joint, from the base to the tip.
#pragma once

#include <array>
#include <cstdint>

namespace liana::serial {

constexpr std::int32_t kMaxJoints = 8;  // compiled capacity; a robot within it needs a new table and no new code

using JointVector = std::array<double, kMaxJoints>;  // from the base to the tip [rad], [rad/s] ...

}  // namespace liana::serial
