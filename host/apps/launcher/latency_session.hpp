// lianad, a bus and the bench in real time; the tip goes to and fro while the real-time thread is measured.
#pragma once

#include <string>

#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/state_monitor.hpp"
#include "host/apps/launcher/system.hpp"
#include "host/apps/report/latency_measurement.hpp"
#include "host/base/json/json.hpp"

namespace liana::launcher {

// The layout for it: bus and bench stand for hardware, which is never late for want of a processor; they run in real
// time, under lianad's real-time thread.
SystemLayout for_latency(SystemLayout layout);

class LatencySession {
 public:
  // `plan`: without a mission, in real time (for_latency). It must outlive this.
  explicit LatencySession(const SystemLayout& plan);
  // Stops the arm and ends the programs.
  ~LatencySession();
  LatencySession(const LatencySession&) = delete;
  LatencySession& operator=(const LatencySession&) = delete;

  // Starts the programs, enables the arm, waits for it to rest, measures for `seconds` while its tip goes to and fro;
  // an arm that cannot be enabled is measured as it is. Throws std::runtime_error with what a program that ended said
  // last, or when it was interrupted.
  report::LatencyMeasurement measure(double seconds);

 private:
  void start();
  // False when the arm got into FAULT, or did not get there in time.
  bool enable();
  // Takes in one message within `timeout_s`: a state, or the answer to a request.
  void look(double timeout_s);
  // Waits until the arm is in `state`, homed and at rest; false after a fault or too long a time.
  bool reaches(const std::string& state);
  // Sends the tip on its next way, when it has come to the end of the last.
  void keep_moving();
  // Sends a request and waits for its answer, ok or error.
  Json ask(Json request);
  void require_alive(double settle_s = 0.0);

  InterruptGuard interrupts_;
  System system_;
  StateMonitor watch_;
  Json state_ = Json::object(), answer_ = Json::object();  // the last ones
  int last_id_ = 0;
  Json ends_ = Json::array();  // tip poses, of which the tip goes to the first next
};

}  // namespace liana::launcher
