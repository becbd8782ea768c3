// lianad's state in words, for a person at a terminal. `state` is as in docs/reference/api.md.
#pragma once

#include <string>

#include "host/base/json/json_fwd.hpp"

namespace liana::terminal {

// Of `stop` of the state: "anna: smoke", or "liana estop" where no reason was given.
std::string stopped_by(const Json& stop);

// Why the arm is not homed; empty while it is homed, and while its drives boot.
std::string why_not_homed(const Json& state);

// What is left of the way back: "back, 42 % of the path left (21 of 50 points)"; empty when the arm does not go back.
std::string retract_progress(const Json& state);

// What `liana status` prints of one system, in lines that each end in a newline.
std::string state_text(const Json& state);

}  // namespace liana::terminal
