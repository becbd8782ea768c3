// The status lines of the terminal.
#pragma once

#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"
#include "host/operator/terminal/jog.hpp"

namespace liana::terminal {

// What a session knows beside lianad's state.
struct Shown {
  std::string name;   // ours, as owner of motion
  std::string robot;  // name of its table
  JogSpeed speed;
  bool is_jogging = false;
  std::string said;  // what became of what was asked last
};

// `state` as in docs/reference/api.md, or an empty object before the first. Lines are cut at `columns`, and end in no
// newline.
std::vector<std::string> status_lines(const Json& state, const Shown& shown, std::size_t columns);

}  // namespace liana::terminal
