#include "firmware_like/serial/joint_friction.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::serial {

namespace {

using Index = std::size_t;

// The slide is over: its mean is believed when it lasted long enough.
void end_slide(const RobotParams& table, JointFriction& joint) noexcept {
  const double counted = joint.ticks - kBeginsToSlide_s / table.tick_s;
  if (counted * table.tick_s >= kMinSlide_s)
    joint.coulomb_Nm = clamp(joint.sum_Nm / counted, 0.0, kFrictionShare * table.torque.coulomb_Nm);
  joint.sum_Nm = 0.0;
  joint.ticks = 0;
}

}  // namespace

FrictionFound declared_friction(const RobotParams& table) noexcept {
  FrictionFound found{};
  for (Index i = 0; i < table.joints(); ++i) found[i].coulomb_Nm = table.torque.coulomb_Nm;
  return found;
}

void find_friction(const RobotParams& table, const JointVector& rate_rad_s, const JointVector& moving_Nm,
                   const JointVector& measured_Nm, FrictionFound& found) noexcept {
  for (Index i = 0; i < table.joints(); ++i) {
    JointFriction& joint = found[i];
    const double rate = rate_rad_s[i];
    const bool slides = std::fabs(rate) >= kSlides_rad_s && (joint.ticks == 0 || rate * joint.rate_rad_s > 0.0);
    joint.rate_rad_s = rate;
    if (!slides) {
      end_slide(table, joint);
      continue;
    }
    if (++joint.ticks <= kBeginsToSlide_s / table.tick_s) continue;
    const double against_Nm = measured_Nm[i] - moving_Nm[i] - table.torque.viscous_Nms_per_rad * rate;
    joint.sum_Nm += rate < 0.0 ? -against_Nm : against_Nm;
  }
}

JointVector friction_Nm(const RobotParams& table, const FrictionFound& found, const JointVector& rate_rad_s) noexcept {
  JointVector torque{};
  for (Index i = 0; i < table.joints(); ++i) {
    const double rate = rate_rad_s[i];
    const double size = std::sqrt(rate * rate + kFrictionSmooth_rad_s * kFrictionSmooth_rad_s);
    torque[i] = found[i].coulomb_Nm * rate / size + table.torque.viscous_Nms_per_rad * rate;
  }
  return torque;
}

}  // namespace liana::serial
