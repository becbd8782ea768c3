#include "host/operator/haptics/hand.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/control/virtual_fixtures/hand_motion.hpp"

namespace liana::haptics {
namespace {

constexpr std::uint64_t kTremorPurpose = 31;
constexpr double kTremor_rad_s = 2.0 * std::numbers::pi * 10.0;  // middle of 8 to 12 Hz

double damping_of(const HandParams& table, double moved_kg) {
  const double critical = 2.0 * std::sqrt(table.stiffness_N_m * (table.mass_kg + moved_kg));
  return std::max(table.damping_ratio * critical, table.min_damping_N_s_m);
}

}  // namespace

Hand::Hand(const HandParams& table, double moved_kg, std::uint64_t seed)
    : table_(table),
      tremor_(1.0, 0.0, seed, kTremorPurpose),
      damping_N_s_m_(damping_of(table, moved_kg)),
      tremor_N_(table.tremor_m * (table.mass_kg + moved_kg) * kTremor_rad_s * kTremor_rad_s),
      reaction_(static_cast<std::size_t>(
          std::clamp(std::lround(table.reaction_s / kTick_s), 0L, static_cast<long>(kLongest - 1)))) {}

void Hand::intend(const Intent& intent) noexcept {
  if (!begun_) {
    waiting_.fill(intent);
    acted_ = intent;
    begun_ = true;
  }
  waiting_[next_] = intent;
  const Vec3 before = acted_.position_m;
  acted_ = waiting_[(next_ + kLongest - reaction_) % kLongest];
  speed_m_s_ = scale(subtract(acted_.position_m, before), 1.0 / kTick_s);
  next_ = (next_ + 1) % kLongest;
}

void Hand::tremble(double t_s) noexcept { trembling_N_ = scale(tremor_.apply({}, t_s).position_m, tremor_N_); }

Vec3 Hand::force(const Vec3& position_m, const Vec3& velocity_m_s) const noexcept {
  const Vec3 spring = scale(subtract(acted_.position_m, position_m), table_.stiffness_N_m);
  const Vec3 damper = scale(subtract(speed_m_s_, velocity_m_s), damping_N_s_m_);
  return add(add(spring, damper), trembling_N_);
}

}  // namespace liana::haptics
