// The simulated arm for a console: bus, lianad and bench without a mission, until Ctrl-C.
#pragma once

#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/state_monitor.hpp"
#include "host/apps/launcher/system.hpp"

namespace liana::launcher {

class ConsoleSession {
 public:
  // `plan` must outlive this.
  explicit ConsoleSession(const SystemLayout& plan) : system_(plan) {}
  // Stops the arm and ends what still runs.
  ~ConsoleSession();
  ConsoleSession(const ConsoleSession&) = delete;
  ConsoleSession& operator=(const ConsoleSession&) = delete;

  // Starts everything. Throws Interrupted, and std::runtime_error with what did not start.
  void start();
  // Goes on for `look_s` at most; false after Ctrl-C. Throws std::runtime_error with the program that has ended.
  bool go_on(double look_s = 0.05);

 private:
  void require_alive();
  void revive_recorder();

  InterruptGuard interrupts_;
  System system_;
  StateMonitor watch_;
  bool has_begun_ = false;  // before the first state lianad waits for the recorder
  int recorders_ = 1;
};

}  // namespace liana::launcher
