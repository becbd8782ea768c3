// How long something took, tick after tick: counted by the real-time thread, read by the service, without either
// waiting.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace liana::realtime {

constexpr std::size_t kLatencyBuckets = 2048;  // of 1 us each; what takes longer is counted together

// What a histogram held when it was read.
struct LatencyCounts {
  std::array<std::uint64_t, kLatencyBuckets + 1>
      count{};                 // [i]: i us to under i + 1 us; the last one: kLatencyBuckets us or more
  std::uint32_t worst_us = 0;  // exact, beyond the buckets too

  std::uint64_t total() const;
  // The smallest time that at least `share` (over 0, up to 1) of all stayed within [us]; the worst where it lies beyond
  // the buckets, 0 where nothing was counted. The same as the nearest rank in the sorted times.
  std::uint32_t percentile_us(double share) const;
};

// One writer thread, one reader thread. Relaxed atomics that only the writer changes, so record() costs a load and a
// store; a reset moves what the reader subtracts, and the writer never hears of it.
class LatencyHistogram {
 public:
  // Writer: counts one time. Bounded, no allocation.
  void record(std::uint32_t time_us) noexcept {
    std::atomic<std::uint64_t>& count = count_[time_us < kLatencyBuckets ? time_us : kLatencyBuckets];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    if (time_us > worst_us_.load(std::memory_order_relaxed)) worst_us_.store(time_us, std::memory_order_relaxed);
  }
  // Reader: what was recorded since the last reset. A tick that runs at this moment may be in it or not.
  LatencyCounts counts() const;
  // Reader: counts() begins anew.
  void reset();

 private:
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
  std::array<std::atomic<std::uint64_t>, kLatencyBuckets + 1> count_{};
  std::atomic<std::uint32_t> worst_us_{0};
  std::array<std::uint64_t, kLatencyBuckets + 1> before_{};  // the reader's: counts at the last reset
};

// The real-time thread's times, one of each per tick, in real time; in virtual time they mean nothing.
struct TickTiming {
  LatencyHistogram wakeup_us;  // from the deadline of the tick to the thread running (TickStart::lateness_us)
  // The tick's own work: from the return of DriveBus::wait_feedback (every drive's feedback is there, or half the
  // period is over) to the end of the tick with its reports published. SYNC and the wait for the bus are not in it.
  // Difference of two whole microseconds: +-1 us.
  LatencyHistogram tick_us;
};

}  // namespace liana::realtime
