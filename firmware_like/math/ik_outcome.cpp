#include "firmware_like/math/ik_outcome.hpp"

namespace liana {

const char* ik_outcome_name(IkOutcome outcome) noexcept {
  constexpr std::array<const char*, 5> kNames{"converged", "approaching", "limited", "singular", "unreachable"};
  return kNames[static_cast<std::size_t>(outcome)];
}

std::array<double, 6> pose_error(const Pose& goal, const Pose& tip) noexcept {
  const Vec3 p = subtract(goal.position_m, tip.position_m);
  const Vec3 r = rotation_vector(multiply(goal.quaternion, conjugate(tip.quaternion)));
  return {p[0], p[1], p[2], r[0], r[1], r[2]};
}

}  // namespace liana
