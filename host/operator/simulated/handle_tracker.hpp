// How a VR handle is tracked: the hand's tremor, one sample far off now and then, short losses.
#pragma once

#include <cstdint>

#include "host/api/device/sample.hpp"
#include "host/base/random/random.hpp"
#include "host/operator/simulated/tremor.hpp"

namespace liana::simulated {

struct TrackingTable {
  double tremor_m = 0.0002;       // RMS of each axis, of the hand
  double tremor_rad = 0.0005;     // RMS of each axis
  double jump_m = 0.5;            // one sample is this far off
  double between_s = 20.0;        // mean time from a jump or loss to the next
  double dropout_least_s = 0.06;  // a loss lasts that long at least
  double dropout_most_s = 0.16;   // and less than the 0.25 s after which the arbiter lets go
};

// Deterministic: the same calls give the same samples. Times do not go back.
class HandleTracker {
 public:
  // `purpose` separates the handles of one seed; it takes two numbers, this one and the next.
  HandleTracker(const TrackingTable& table, std::uint64_t seed, std::uint64_t purpose);

  // What the tracker tells of a handle at `pose` at `now_s`, its trigger closed when `held`; as hand 0.
  device::Sample track(const Pose& pose, bool held, double now_s);

 private:
  double next_after(double now_s);

  TrackingTable table_;
  Tremor tremor_;
  RandomStream random_;
  double jump_s_;
  double lost_from_s_;
  double lost_to_s_;
  Pose last_{};
};

}  // namespace liana::simulated
