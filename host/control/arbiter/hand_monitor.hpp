// What a hand can do, and so which samples are none of a hand's: a tracker that jumps, and one whose numbers are stuck.
//
// A step is judged by the speed and the acceleration that it implies by the device's own clock, never by its size
// alone. What jumps for a sample and comes back is left out; what jumps and stays is not followed.
#pragma once

#include <cstdint>
#include <optional>

#include "host/api/device/capability.hpp"
#include "host/api/device/sample.hpp"

namespace liana::arbiter {

// Between two samples. A quick hand comes to 1.5 m/s and 15 m/s2, and trembles besides.
struct HandLimits {
  double speed_m_s = 2.5;
  double turn_rad_s = 15.0;
  double accel_m_s2 = 25.0;
  double turn_accel_rad_s2 = 400.0;
  bool trembles = true;  // its numbers vary: those that do not any more are stuck
};

// A pointer's pose is made of a rate: it starts at once, goes no faster than its driver may let it, and stands exactly.
HandLimits limits_of(device::Kind kind);

class HandMonitor {
 public:
  enum class Finding : std::uint8_t {
    kHand,      // may be followed
    kUnseen,    // has no pose, or is older than the one before
    kDoubtful,  // no hand does that: left out, until the next one tells
    kJumped,    // and it stays there: has to be let go
    kStuck,     // numbers that always varied, of a hand that moved or trembled, are the same for kStuck_us
  };

  static constexpr std::int64_t kProof_us = 200'000;  // so long without a repetition: its numbers vary
  static constexpr std::int64_t kStuck_us = 60'000;   // with an interval more it is less than 0.1 s
  static constexpr std::int64_t kDoubt_us = 50'000;   // neither here nor there for so long: jumped

  explicit HandMonitor(const HandLimits& limits = {}) : limits_(limits) {}

  // The next sample of one hand. While its deadman is open, and where it closes, everything is a hand's: it leads
  // nothing. After kJumped and kStuck the hand is where the sample says.
  Finding judge(const device::Sample& sample);

 private:
  struct Track {
    Pose pose{};
    std::int64_t t_us = 0;
    Vec3 velocity_m_s{}, rate_rad_s{};
    bool is_moving_known = false;
    Vec3 step_m_s{}, step_rad_s{};    // of the last step alone
    double steps = 0.0, bends = 0.0;  // mean speed, and mean change of it from step to step
  };

  bool leads_to(const Track& from, const device::Sample& to) const;
  Finding judge_held(const device::Sample& sample);
  bool is_stuck(const device::Sample& sample);
  bool could_not_stop() const;
  void note_tremor(const Vec3& velocity_m_s, const Vec3& rate_rad_s, double dt_s);
  void follow(const device::Sample& sample);

  HandLimits limits_;
  std::optional<Track> hand_;   // the last sample that was one
  std::optional<Track> doubt_;  // the last one that was not
  std::int64_t doubt_from_us_ = 0;
  std::int64_t varies_from_us_ = 0;           // no two alike since
  std::optional<std::int64_t> same_from_us_;  // all alike since, after they had varied
  bool is_held_ = false;
};

}  // namespace liana::arbiter
