// A scripted stand-in for lianad: real socket, real packets, an arm that obeys at once. Written from
// docs/reference/api.md alone.
#pragma once

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "host/base/json/json.hpp"

namespace liana::mission_runner {

// What goes wrong, and how the operator behaves.
struct FakeBehaviour {
  std::map<std::string, std::string> refuse = {};  // op -> error code
  int refuse_in_step = 0;                          // only from this step on (0 = always)
  bool operator_arrives = true;                    // releases and says so in device steps
  bool operator_speaks_too_early = false;          // says "arrived" once, before step 2, and only then
  int fault_in_step = 0;                           // FAULT state while this step runs
  int hold_fault_in_step = 0;                      // a fault that holds the arm and leaves it enabled
  int refuse_motion_in_step = 0;                   // verification refuses a setpoint of the motion
  int stop_in_step = 0;                            // somebody presses the emergency stop
  int vanish_in_step = 0;                          // lianad dies
  int silent_in_step = 0;                          // sends no more states, waits for the runner to leave
  int slow_in_step = 0;                            // lets the runner wait for longer than the watchdog's limit, once
  int steal_in_step = 0;                           // another owner
  bool way_back_ends_early = false;                // retract is accepted, but does not go all the way
  bool way_back_stalls = false;                    // retract is accepted, and nothing comes of it
  std::vector<std::pair<int, std::string>> people = {};  // (step, command): each once, and so far into that step
  int people_after_intervals = 25;                       // in step 0 since the first state
  bool hold_fault_goes = false;                          // once nobody owns motion any more
  double speed_share = 1.0;                              // of the tip's speed, what a hand is left
  double tip_in_slit_u_m = 3.2;                          // where the hand steps bring the tip
};

// Serves one mission runner at `path` until it leaves; its log holds every request in order.
class FakeLianad {
 public:
  FakeLianad(const std::string& path, const FakeBehaviour& behaviour);
  ~FakeLianad();
  FakeLianad(const FakeLianad&) = delete;
  FakeLianad& operator=(const FakeLianad&) = delete;

  // Waits for the end of the session and returns the requests (without done).
  const std::vector<Json>& requests();
  // True when the silent fake saw the runner's socket close.
  bool runner_left() {
    requests();
    return runner_left_;
  }

 private:
  void serve();
  void converse();
  void send(const Json& message) const;
  bool handle_until_done();
  void answer(const Json& request);
  void obey(const Json& request);
  void advance();
  void listen_to_people();
  Json state() const;
  Json retract() const;
  int planar_segments() const;
  Json named_pose(const char* name) const;

  FakeBehaviour behaviour_;
  bool asked_back_ = false;
  Json robot_;
  Json scene_;
  int listener_ = -1;
  int client_ = -1;
  std::thread thread_;
  std::vector<Json> requests_;
  bool runner_left_ = false;

  // The arm.
  std::int64_t tick_ = 0;
  std::string state_ = "BOOTING";
  bool is_homed_ = false;
  std::string owner_;
  std::string device_ = "none";
  bool engaged_ = false;
  int intervals_with_device_ = 0;
  int busy_intervals_ = 0, path_intervals_ = 0;
  int step_ = 0;
  Json goal_deg_;
  Json js_deg_;
  Json tip_;
  Json held_ = Json::array();
  Json said_;
  std::size_t asked_ = 0;  // of `people`
  int intervals_in_step_ = 0;
};

}  // namespace liana::mission_runner
