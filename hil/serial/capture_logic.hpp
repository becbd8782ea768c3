// When the adapter says "captured": two of its three depth sensors at full depth and the third almost, for a while.
#pragma once

#include <algorithm>
#include <array>

namespace liana::bench {

constexpr std::size_t kPins = 3;
using PinValues = std::array<double, kPins>;

class CaptureLogic {
 public:
  static constexpr double kFull_m = 0.020;  // assumed, as all of the adapter's figures
  static constexpr double kAlmost_m = 0.0195;
  static constexpr double kHold_s = 0.05;

  // The readings of this step; true once they have held long enough, and from then on.
  bool step(double step_s, const PinValues& depth_m) {
    const auto full = std::count_if(depth_m.begin(), depth_m.end(), [](double depth) { return depth > kFull_m; });
    const bool all = std::all_of(depth_m.begin(), depth_m.end(), [](double depth) { return depth > kAlmost_m; });
    held_s_ = full >= 2 && all ? held_s_ + step_s : 0.0;
    captured_ = captured_ || held_s_ >= kHold_s - 1e-9;
    return captured_;
  }
  bool captured() const { return captured_; }

 private:
  double held_s_ = 0.0;
  bool captured_ = false;
};

}  // namespace liana::bench
