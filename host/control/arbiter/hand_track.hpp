// One tracked hand: samples at device rate in, one averaged reading per command interval out. Every sample is counted.
#pragma once

#include <cstdint>

#include "host/api/device/sample.hpp"

namespace liana::arbiter {

// What one command interval of samples says.
struct HandReading {
  std::uint32_t samples = 0;  // all that came
  std::uint32_t used = 0;     // averaged into `mean`: those with the deadman closed, since it was open last
  bool let_go = false;        // the deadman was open in at least one sample
  bool pressed = false;       // closed in the newest sample
  bool lost = false;          // no usable pose for longer than kTrackingLost_s
  bool has_mean = false;      // `mean` is from this interval; otherwise from an earlier one
  Pose mean{};
};

constexpr double kTrackingLost_s = 0.25;

class HandTrack {
 public:
  // Takes one sample; times must not go back (such samples are counted and ignored).
  void add_sample(const device::Sample& sample);
  // The reading of the interval that ends now; the next interval starts empty.
  HandReading finish_interval();

 private:
  void average_in(const Pose& pose);

  HandReading reading_{};
  Vec3 position_sum_m_{}, turn_sum_rad_{};
  Pose first_{};  // reference of the rotation average
  std::int64_t last_t_us_ = 0, last_good_t_us_ = 0;
  bool any_ = false, any_good_ = false;
};

}  // namespace liana::arbiter
