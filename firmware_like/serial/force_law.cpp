#include "firmware_like/serial/force_law.hpp"

namespace liana::serial {
namespace {

Vec3 along(const Vec3& axis, const Vec3& v) noexcept { return scale(axis, dot(axis, v)); }

// Shorter by the band; what is inside it is nothing.
Vec3 less_band(const Vec3& v, double band) noexcept {
  const double size = norm(v);
  return size > band ? scale(v, (size - band) / size) : Vec3{};
}

Vec3 damped(const Vec3& v, const Vec3& force, double mass, double damping, double tick_s) noexcept {
  const double h = tick_s / mass;
  return scale(add(v, scale(force, h)), 1.0 / (1.0 + h * damping));
}

}  // namespace

Wrench drive_of(InsertLaw law, const InsertGains& gains, const LawInputs& in) noexcept {
  if (law == InsertLaw::kImpedance) {
    return {subtract(scale(in.away_m, gains[kStiffness]), in.given.force_N),
            subtract(scale(in.away_rad, gains[kTurnStiffness]), in.given.torque_Nm)};
  }
  const Vec3 missing_N = subtract(in.set.force_N, in.given.force_N);
  const Vec3 axial_N = along(in.axis, missing_N);
  const Vec3 lateral_N = less_band(subtract(missing_N, axial_N), kLateralDeadBand_N);
  const Vec3 turning_Nm = less_band(subtract(in.set.torque_Nm, in.given.torque_Nm), kTurnDeadBand_Nm);
  return {scale(add(axial_N, lateral_N), gains[kForceGain]), scale(turning_Nm, gains[kForceGain])};
}

Twist law_step(InsertLaw law, const InsertGains& gains, const LawInputs& in, const Twist& velocity) noexcept {
  const Wrench drive = drive_of(law, gains, in);
  const Vec3 axial_m_s = along(in.axis, velocity.linear_m_s), axial_N = along(in.axis, drive.force_N);
  const Vec3 lateral_m_s = subtract(velocity.linear_m_s, axial_m_s), lateral_N = subtract(drive.force_N, axial_N);
  return {add(damped(axial_m_s, axial_N, gains[kPushMass], in.axial_damping, in.tick_s),
              damped(lateral_m_s, lateral_N, gains[kPushMass], gains[kLateralDamping], in.tick_s)),
          damped(velocity.angular_rad_s, drive.torque_Nm, gains[kPushInertia], gains[kTurnDamping], in.tick_s)};
}

}  // namespace liana::serial
