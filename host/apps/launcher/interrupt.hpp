// What Ctrl-C does to `liana`.
#pragma once

#include <atomic>
#include <csignal>

namespace liana::launcher {

// From now on Ctrl-C ends the program with kExitInterrupted and one message, unless whoever started it wants Ctrl-C
// ignored.
void end_on_interrupt();

// While it lives, Ctrl-C and SIGTERM are counted instead of ending the program. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  // How many came so far.
  int count() const;
  // Whether one came; set by the signal's handler.
  const std::atomic<bool>& any() const;

 private:
  void (*before_int_)(int);
  void (*before_term_)(int);
};

}  // namespace liana::launcher
