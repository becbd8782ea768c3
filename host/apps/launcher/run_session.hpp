// The processes of one run: started in order, watched, ended together.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/progress.hpp"
#include "host/apps/launcher/sample_monitor.hpp"
#include "host/apps/launcher/state_monitor.hpp"
#include "host/apps/launcher/system.hpp"
#include "host/apps/report/run_report.hpp"
#include "host/base/json/json.hpp"

namespace liana::launcher {

// How a run ended, as far as the processes tell.
struct RunResult {
  std::string outcome;     // empty: the mission's own report says it
  std::string message;     // why, when something went wrong outside the mission
  bool bad_input = false;  // a program refused what it was given before anything moved
};

class RunSession {
 public:
  explicit RunSession(const SystemLayout& plan);
  ~RunSession();
  RunSession(const RunSession&) = delete;
  RunSession& operator=(const RunSession&) = delete;

  // Starts everything, waits until the mission has ended, ends everything. Ctrl-C is a stop; a second one ends at once.
  RunResult run();

  // All of a simulated arm, of real drives the last one and no claims.
  const std::vector<report::StateSample>& states() const { return states_; }
  const std::vector<report::Stage>& stages() const { return stages_; }
  const std::vector<report::ClearanceBounds>& claims() const { return claims_; }
  // Of the operators' devices.
  const SampleMonitor& samples() const { return samples_; }
  const std::vector<report::ReportedStep>& announced() const { return announced_; }
  const Json& welcome() const { return welcome_; }
  const Json& last_state() const { return last_state_; }

 private:
  RunResult watch();
  bool matters(const ChildProcess& child) const;
  void revive_recorder();
  void say_how_the_recorder_ended();
  bool has_failed(const RunResult& end) const;
  void follow();
  RunResult conclusion();
  std::optional<RunResult> dead_child(bool failed_only);
  RunResult end_of_mission(const ExitStatus& end);
  RunResult interrupted();
  void look(double timeout_s);
  void say_silence();
  void look_until(double timeout_s, const std::function<bool()>& is_over);
  void take(Json message);
  void keep(const Json& state);
  bool is_ending() const;
  bool is_stopped() const;
  std::string how_the_arm_was_left() const;

  const SystemLayout& plan_;
  // The report is made of states: in virtual time none may be lost to a slow moment, or equal runs had unequal reports.
  const bool waits_for_us_;
  const bool has_bench_;  // whose truth the report compares with all states; without it the last one says when it ended
  InterruptGuard interrupts_;
  Progress progress_;
  System system_;
  StateMonitor watch_;
  int recorders_ = 1;  // that were started
  Json welcome_;
  Json last_state_;
  std::uint64_t states_seen_ = 0;
  std::vector<report::StateSample> states_;
  std::vector<report::Stage> stages_;
  std::vector<report::ClearanceBounds> claims_;
  std::vector<report::ReportedStep> announced_;
  SampleMonitor samples_;
};

}  // namespace liana::launcher
