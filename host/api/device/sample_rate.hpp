// How often samples of a device come, by the device's own clock: what reaches the arm late in a bundle is not slow
// (A24).
#pragma once

#include <cstdint>
#include <optional>

namespace liana::device {

// Least rate at which an operator's input is sampled [Hz]; a clock that is half a hertz off is not an alarm (A24).
constexpr double kMinRate_hz = 50.0;
constexpr double kRateTolerance_hz = 0.5;

class SampleRate {
 public:
  // One sample taken at `t_us` by the device's clock; one that is not newer than the one before counts, but has no
  // interval.
  void add(std::int64_t t_us);
  // Ends a command interval of `interval_s`; once a second the rate is taken anew.
  void finish_interval(double interval_s);

  std::uint64_t count() const { return count_; }
  // In the last whole second [Hz], 0 when none came in it; nothing before a second is over since the first.
  std::optional<double> now_hz() const { return now_hz_; }
  // From the first to the newest sample [Hz]; 0 while there is no interval.
  double mean_hz() const;
  // Shortest and longest time from one sample to the next [s]; 0 while there is none.
  double least_s() const { return intervals_ > 0 ? min_s_ : 0.0; }
  double most_s() const { return max_s_; }
  // Samples came, and since then fewer in a second than kMinRate_hz. It ends when there are as many again.
  bool is_slow() const { return is_slow_; }

 private:
  std::uint64_t count_ = 0, intervals_ = 0;
  std::int64_t first_us_ = 0, last_us_ = 0;
  double min_s_ = 0.0, max_s_ = 0.0;
  double second_s_ = 0.0;            // of the second that has begun
  std::uint64_t in_second_ = 0;      // intervals that ended in it
  std::int64_t second_from_us_ = 0;  // newest sample before it
  std::optional<double> now_hz_;
  bool is_slow_ = false;
};

}  // namespace liana::device
