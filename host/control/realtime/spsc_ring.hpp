// Lock-free queue for one writer thread and one reader thread.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <type_traits>

namespace liana::realtime {

// Holds up to N-1 items; both ends are wait-free and allocate nothing. N is a power of two.
template <class T, std::size_t N>
class SpscRing {
  static_assert(std::is_trivially_copyable_v<T> && N >= 2 && (N & (N - 1)) == 0);

 public:
  // Writer: false when full, and the item is not stored.
  bool push(const T& item) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == N - 1) return false;
    items_[head & (N - 1)] = item;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }
  // Reader: the oldest item, or nullptr; stays valid until pop().
  const T* front() const {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    return tail == head_.load(std::memory_order_acquire) ? nullptr : &items_[tail & (N - 1)];
  }
  // Reader: drops the oldest item; front() must have returned one.
  void pop() { tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

 private:
  alignas(64) std::atomic<std::size_t> head_{0};
  alignas(64) std::atomic<std::size_t> tail_{0};
  std::array<T, N> items_{};
};

}  // namespace liana::realtime
