// Marks the thread as being inside a tick, where nothing may allocate, lock or open files. The test build enforces it
// (alloc_guard.cpp).
#pragma once

namespace liana::realtime {

class TickGuard {
 public:
  TickGuard() { inside_ = true; }
  ~TickGuard() { inside_ = false; }
  TickGuard(const TickGuard&) = delete;
  TickGuard& operator=(const TickGuard&) = delete;
  // True while this thread is inside a tick.
  static bool active() { return inside_; }

 private:
  static inline thread_local bool inside_ = false;
};

}  // namespace liana::realtime
