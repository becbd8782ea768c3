// The status lines of the terminal.
#pragma once

#include <cstddef>
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
  std::string said;            // what became of what was asked last
  double silent_s = 0.0;       // since lianad's last state, once that is too long ago; else 0
  double unconfirmed_s = 0.0;  // since an emergency stop was asked for, once its answer is late; else 0
};

// Of a terminal [letters].
struct Size {
  std::size_t columns = 80;
  std::size_t rows = 24;
};

// `state` as in docs/reference/api.md, or an empty object before the first. Long lines go on in the next ones, none is
// longer than the columns. Faults and refusals get the rows that the rest leaves: all of it fits 80 x 24. Lines end in
// no newline.
std::vector<std::string> status_lines(const Json& state, const Shown& shown, Size size);

}  // namespace liana::terminal
