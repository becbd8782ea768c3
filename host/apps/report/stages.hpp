// What lianad told of visual servo, force control and adapter, kept where it changes: the controller's side of a
// payload's installation (docs/reference/api.md: `servo`, `push`, `adapter` of the state).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::report {

// One state of them, and the tick of the first state message that said so.
struct Stage {
  std::uint64_t tick = 0;
  std::string servo = "standby";  // phase
  std::string target;             // of the servo
  std::optional<Pose> place;      // where the servo brings its point, in the target's frame
  std::string push = "none";      // phase
  std::string push_end = "none";  // how it ended
  double set_N = 0.0;
  bool says_captured = false;  // the adapter does

  bool servo_is_under_way() const { return servo == "approaching" || servo == "dwelling"; }
  bool push_is_under_way() const { return push == "taring" || push == "relieving" || push == "pressing"; }
};

// Takes in what a state says, where anything of it is new. A state without servo or push has none.
void keep_stage(std::vector<Stage>& stages, const Json& state);

// A servo or a push from its begin to its end; of one that is under way at the end of the run, `end_tick` is the tick
// of the last stage.
struct Span {
  std::uint64_t begin_tick = 0;
  std::uint64_t end_tick = 0;
  std::string end;            // of a servo its last phase, of a push why it ended; "none": it did not
  std::string target;         // of a servo
  std::optional<Pose> place;  // of a servo
};

// In the order in which they were begun.
std::vector<Span> servos_of(const std::vector<Stage>& stages);
std::vector<Span> pushes_of(const std::vector<Stage>& stages);

}  // namespace liana::report
