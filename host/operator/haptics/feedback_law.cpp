#include "host/operator/haptics/feedback_law.hpp"

namespace liana::haptics {
namespace {

Vec3 spring_damper(const LawGains& gains, double damping_N_s_m, const Motion& robot, const Motion& other) {
  const Vec3 apart_m = subtract(robot.position_m, other.position_m);
  const Vec3 spring = scale(subtract(apart_m, no_longer(apart_m, gains.unsure_m)), gains.stiffness_N_m);
  const Vec3 damper = scale(subtract(robot.velocity_m_s, other.velocity_m_s), damping_N_s_m);
  return scale(add(spring, damper), 1.0 / gains.scale);
}

}  // namespace

std::optional<Law> law_of(std::string_view name) {
  for (std::size_t i = 0; i < kLawNames.size(); ++i) {
    if (kLawNames[i] == name) return static_cast<Law>(i);
  }
  return std::nullopt;
}

Vec3 law_force(Law law, const LawGains& gains, const LawInputs& inputs) noexcept {
  switch (law) {
    case Law::kClaim:
      return spring_damper(gains, gains.damping_N_s_m, inputs.robot, inputs.commanded);
    case Law::kAbstract:
      return spring_damper(gains, gains.damping_N_s_m, inputs.robot, inputs.predicted_now);
    case Law::kAligned:
      return spring_damper(gains, 0.0, inputs.robot, inputs.predicted_then);
  }
  return {};
}

}  // namespace liana::haptics
