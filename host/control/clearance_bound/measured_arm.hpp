// What the drives show of the arm, at one moment, and what it was a moment ago.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::clearance_bound {

using namespace cable;  // this room serves the cable arm only

struct MeasuredArm {
  ThetaVector theta_rad{};
  ThetaVector rate_rad_s{};
};

// The last second and a quarter, one entry a command interval: pictures arrive late.
class ArmHistory {
 public:
  explicit ArmHistory(double tick_s) : tick_s_(tick_s) {}

  // `tick` rises from call to call.
  void note(std::uint64_t tick, const ThetaVector& theta_rad);
  // Between the two entries around `tick`, with the mean rate of the kRateEntries before it; nothing where it does not
  // reach back or on that far.
  std::optional<MeasuredArm> at(std::uint64_t tick) const;

 private:
  static constexpr std::size_t kEntries = 64;
  static constexpr std::size_t kRateEntries = 5;  // 0.1 s: noise of drive torque would pass for motion

  struct Entry {
    std::uint64_t tick = 0;
    ThetaVector theta_rad{};
  };
  const Entry& entry(std::size_t age) const { return ring_[(newest_ + kEntries - age) % kEntries]; }
  ThetaVector rate_at(std::size_t age) const;

  double tick_s_;
  std::array<Entry, kEntries> ring_{};
  std::size_t newest_ = 0, count_ = 0;
};

}  // namespace liana::clearance_bound
