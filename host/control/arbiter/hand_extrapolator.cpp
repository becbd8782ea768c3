#include "host/control/arbiter/hand_extrapolator.hpp"

#include <algorithm>

namespace liana::arbiter {

void HandExtrapolator::see(const Pose& hand, double interval_s) {
  if (any_) {
    const double since_s = unseen_s_ + interval_s;
    const double share = std::min(1.0, since_s / kHandVelocity_s);
    const Vec3 velocity_m_s = scale(subtract(hand.position_m, seen_.position_m), 1.0 / since_s);
    const Vec3 rate_rad_s =
        scale(rotation_vector(multiply(hand.quaternion, conjugate(seen_.quaternion))), 1.0 / since_s);
    velocity_m_s_ = add(velocity_m_s_, scale(subtract(velocity_m_s, velocity_m_s_), share));
    rate_rad_s_ = add(rate_rad_s_, scale(subtract(rate_rad_s, rate_rad_s_), share));
  }
  any_ = true;
  at_ = seen_ = hand;
  unseen_s_ = 0.0;
}

const Pose& HandExtrapolator::go_on(double interval_s) {
  unseen_s_ += interval_s;
  if (unseen_s_ > kTrackingLost_s) return at_;
  at_.position_m = add(at_.position_m, scale(velocity_m_s_, interval_s));
  at_.quaternion = normalize(multiply(quaternion_of(scale(rate_rad_s_, interval_s)), at_.quaternion));
  return at_;
}

}  // namespace liana::arbiter
