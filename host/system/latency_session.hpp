// lianad, a bus and the bench in real time, held at rest while the real-time thread is measured.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/api/client.hpp"
#include "host/json/json.hpp"
#include "host/report/latency_measurement.hpp"
#include "host/system/interrupt.hpp"
#include "host/system/process.hpp"
#include "host/system/system_layout.hpp"

namespace liana {

class LatencySession {
 public:
  // `plan`: without a mission, in real time. It must outlive this.
  explicit LatencySession(const SystemLayout& plan);
  // Stops the arm and ends the programs.
  ~LatencySession();
  LatencySession(const LatencySession&) = delete;
  LatencySession& operator=(const LatencySession&) = delete;

  // Starts the programs, enables the arm, waits for it to rest, measures for `seconds`; an arm that cannot be enabled
  // is measured as it is. Throws std::runtime_error with what a program that ended said last, or when it was
  // interrupted.
  LatencyMeasurement measure(double seconds);

 private:
  void start();
  // False when the arm got into FAULT, or did not get there in time.
  bool enable();
  // Takes in one message within `timeout_s`: a state, or the answer to a request.
  void look(double timeout_s);
  // Waits until the arm is in `state`, homed and at rest; false after a fault or too long a time.
  bool reaches(const std::string& state);
  // Sends a request and waits for its answer, ok or error.
  Json ask(Json request);
  void require_alive();
  void shut_down();

  const SystemLayout& plan_;
  InterruptGuard interrupts_;
  std::vector<std::unique_ptr<ChildProcess>> children_;
  std::optional<ApiClient> api_;
  Json state_ = Json::object(), answer_ = Json::object();  // the last ones
  int last_id_ = 0;
};

}  // namespace liana
