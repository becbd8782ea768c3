// Samples of one hand, brought to one age before they lead the arm.
//
// Behind a link whose delay varies, a hand that goes evenly is heard of early, late, and of what was overtaken not at
// all. Followed as it is heard of, its goal runs ahead, stands and jumps by what it goes in a command interval or two,
// and an arm that swings has a cable near slack. So samples wait until the slowest of late would have come too; those
// that never come are put in between.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "host/api/device/sample.hpp"

namespace liana::arbiter {

class JitterBuffer {
 public:
  // Longest time that a sample waits: a device that is silent for longer is let go (kDeviceSilent_s).
  static constexpr std::int64_t kMaxWait_us = 100'000;
  // What is older than two of these says nothing of the link any more.
  static constexpr std::int64_t kWindow_us = 5'000'000;

  // Another device, or another clock.
  void forget() { *this = JitterBuffer{}; }
  // A sample has come that may be followed (hand_monitor.hpp); times rise. One with an open deadman waits for nothing,
  // nor does what came before it.
  void add(const device::Sample& sample);
  // Ends an interval: the samples whose time has come, oldest first. While news is never older by more than an interval
  // than it is at best the link is even, and nothing waits.
  std::vector<device::Sample> finish_interval(double interval_s);
  // The newest sample was older at the end of the last interval than news is at best, by more than kMaxWait_us: the
  // link has become slow, or the device's clock is. It ends with an open deadman, after which the new age counts.
  bool is_late() const { return is_late_; }

 private:
  // Ages of the newest sample at the end of intervals, by two clocks that need not agree: only differences count.
  struct Ages {
    std::int64_t min_us = 0, max_us = 0;
  };

  void bridge(const device::Sample& to);
  void note(std::int64_t age_us);
  Ages ages() const;
  void go_on(std::int64_t interval_us);

  std::deque<device::Sample> queue_;
  std::optional<device::Sample> newest_;
  std::optional<Ages> before_, now_;  // of the window before, and of this one
  std::int64_t arm_us_ = 0;           // intervals that are over
  std::int64_t window_us_ = 0;        // when this window began
  std::int64_t play_us_ = 0;          // what was taken by then has led the arm
  bool waits_ = false;
  bool is_late_ = false;
};

}  // namespace liana::arbiter
