// Runs a function in a process of its own and kills it when it computes for too long: the bound no script can get
// around.
#pragma once

#include <functional>
#include <string>

#include "host/apps/mission_runner/activity.hpp"

namespace liana::mission_runner {

// How long a script may compute between two beats.
struct ScriptTimeLimits {
  double wall_s = 2.0;      // with at least `cpu_s` of computing in it
  double cpu_s = 1.5;       // so that a busy machine is not taken for an endless loop
  double starved_s = 20.0;  // killed after this in any case
};

// How the process ended.
struct WatchedEnd {
  int exit_code = 0;
  bool killed_by_watchdog = false;
  int signal = 0;  // of another killer
};

// Memory for an Activity that parent and child share; lives as long as the process.
Activity& shared_activity();

// Forks, runs `body` in the child (its result is the exit code) and watches the beats of `activity`. The child dies
// with the parent.
WatchedEnd run_watched(Activity& activity, const ScriptTimeLimits& limits, const std::function<int()>& body);

// "file:line" where the script was last seen.
std::string last_seen(const Activity& activity);

}  // namespace liana::mission_runner
