#include "host/operator/haptics/energy_tank.hpp"

#include <algorithm>

namespace liana::haptics {

double EnergyTank::allowed_N(const Vec3& wanted_N, double length_N, const Vec3& moved_m) const noexcept {
  const double along_m = dot(moved_m, wanted_N) / length_N;
  const double way_m = along_m + table_.accel_m_s2 * kTick_s * kTick_s + table_.unseen_m;
  if (way_m <= 0.0) return length_N;  // moves against the force: it takes energy, whatever happens
  return table_.share * std::max(store_J_ - table_.reserve_J, 0.0) / way_m;
}

Vec3 EnergyTank::pass(const Vec3& wanted_N, const Vec3& position_m) noexcept {
  const Vec3 moved_m = begun_ ? subtract(position_m, position_m_) : Vec3{};
  position_m_ = position_m;
  begun_ = true;
  store_J_ = std::min(store_J_ - dot(force_N_, moved_m), table_.most_J);
  const double length_N = norm(wanted_N);
  const double part = length_N > 0.0 ? allowed_N(wanted_N, length_N, moved_m) / length_N : 1.0;
  passed_ = std::min({part, passed_ + table_.regrow_per_s * kTick_s, 1.0});
  force_N_ = scale(wanted_N, passed_);
  return force_N_;
}

}  // namespace liana::haptics
