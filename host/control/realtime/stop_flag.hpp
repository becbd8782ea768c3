// The way of a stop from the service side to the next tick: one flag, which no queue can hold back.
#pragma once

#include <atomic>

namespace liana::realtime {

class StopFlag {
 public:
  // Any thread: the next tick stops the arm. Wait-free; once pressed, pressing again changes nothing.
  void press() { pressed_.store(true, std::memory_order_release); }
  // Pressed, and no tick has taken it yet.
  bool is_pressed() const { return pressed_.load(std::memory_order_acquire); }
  // The tick: true once after each press.
  bool take() { return is_pressed() && pressed_.exchange(false, std::memory_order_acq_rel); }

 private:
  std::atomic<bool> pressed_{false};
};

}  // namespace liana::realtime
