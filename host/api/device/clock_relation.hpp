// How a device's clock stands to the arm's, and how long packets take each way: from round trips, of which the quickest
// has waited least. It is taken to be as long one way as the other.
#pragma once

#include <cstdint>
#include <optional>

namespace liana::device {

class ClockRelation {
 public:
  // One round trip: a state left at `sent_us` of arm time and came at `came_us` of the device's clock; a sample was
  // taken at `taken_us` of that clock, and heard at `heard_us` of arm time. A trip that took less than no time counts
  // not.
  void add(std::int64_t sent_us, std::int64_t came_us, std::int64_t taken_us, std::int64_t heard_us);

  // Arm time less the device's clock; nothing before the first round trip.
  std::optional<std::int64_t> arm_ahead_us() const;
  // Of the newest round trip [s]; 0 before the first.
  double down_s() const { return down_s_; }
  double up_s() const { return up_s_; }

 private:
  // Clocks drift by some 1e-5: what is older than two of these is forgotten.
  static constexpr std::int64_t kWindow_us = 5'000'000;
  struct Quickest {
    std::int64_t took_us = 0, arm_ahead_us = 0;
  };

  std::optional<Quickest> before_, now_;  // of the window before, and of this one
  std::int64_t window_us_ = 0;            // when this one began
  double down_s_ = 0.0, up_s_ = 0.0;
};

}  // namespace liana::device
