#include "host/control/clearance_bound/measured_arm.hpp"

#include <algorithm>

namespace liana::clearance_bound {

void ArmHistory::note(std::uint64_t tick, const ThetaVector& theta_rad) {
  newest_ = (newest_ + 1) % kEntries;
  ring_[newest_] = {tick, theta_rad};
  count_ = std::min(count_ + 1, kEntries);
}

ThetaVector ArmHistory::rate_at(std::size_t age) const {
  ThetaVector rate{};
  const Entry& to = entry(age);
  const Entry& from = entry(std::min(age + kRateEntries, count_ - 1));
  if (from.tick == to.tick) return rate;
  const double time_s = static_cast<double>(to.tick - from.tick) * tick_s_;
  for (std::size_t i = 0; i < rate.size(); ++i) rate[i] = (to.theta_rad[i] - from.theta_rad[i]) / time_s;
  return rate;
}

std::optional<MeasuredArm> ArmHistory::at(std::uint64_t tick) const {
  for (std::size_t age = 0; age < count_; ++age) {
    const Entry& before = entry(age);
    if (before.tick > tick) continue;
    if (before.tick == tick) return MeasuredArm{before.theta_rad, rate_at(age)};
    if (age == 0) return std::nullopt;  // it is not over yet
    const Entry& after = entry(age - 1);
    const double share = static_cast<double>(tick - before.tick) / static_cast<double>(after.tick - before.tick);
    MeasuredArm arm{before.theta_rad, rate_at(age - 1)};
    for (std::size_t i = 0; i < arm.theta_rad.size(); ++i)
      arm.theta_rad[i] += share * (after.theta_rad[i] - before.theta_rad[i]);
    return arm;
  }
  return std::nullopt;
}

}  // namespace liana::clearance_bound
