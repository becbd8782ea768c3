// The newest value from one writer thread to one reader thread, lock-free (triple buffer).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace liana::realtime {

// The writer fills its own slot and swaps it with the middle one; the reader swaps the middle one with its own. Nobody
// ever waits, and a slot is never touched by both.
template <class T>
class LatestValue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit LatestValue(const T& initial) : slots_{initial, initial, initial} {}

  // Writer: makes `value` the newest.
  void publish(const T& value) {
    draft() = value;
    publish();
  }
  // Writer: its own slot, with what an older value left there; to be filled whole, then published.
  T& draft() { return slots_[writing_]; }
  // Writer: makes the draft the newest.
  void publish() { writing_ = middle_.exchange(writing_ | kFresh, std::memory_order_acq_rel) & kIndex; }
  // Reader: true when refresh() would bring a new value.
  bool has_new() const { return (middle_.load(std::memory_order_relaxed) & kFresh) != 0; }
  // Reader: takes over the newest value; true when there was a new one since the last call.
  bool refresh() {
    if (!has_new()) return false;
    reading_ = middle_.exchange(reading_, std::memory_order_acq_rel) & kIndex;
    return true;
  }
  // Reader: the value of the last refresh.
  const T& value() const { return slots_[reading_]; }

 private:
  static constexpr std::uint32_t kFresh = 4, kIndex = 3;
  std::array<T, 3> slots_;
  std::atomic<std::uint32_t> middle_{1};
  std::uint32_t writing_ = 0, reading_ = 2;
};

}  // namespace liana::realtime
