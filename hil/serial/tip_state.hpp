// How a body that is pushed moves, and what pushes it, both in a frame that the context names.
#pragma once

#include "hil/math/vec3.hpp"

namespace liana::bench {

struct TipState {
  Pose pose;
  Vec3 velocity_m_s;  // of the pose's origin
  Vec3 rate_rad_s;
};

// From outside, about the pose's origin.
struct TipLoad {
  Vec3 force_N;
  Vec3 torque_Nm;
};

}  // namespace liana::bench
