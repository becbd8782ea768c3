// A terminal that gives every key at once and is drawn anew from its top.
#pragma once

#include <termios.h>

#include <string>
#include <vector>

#include "host/operator/terminal/status_line.hpp"

namespace liana::terminal {

class Terminal {
 public:
  // Standard input and output; throws std::runtime_error where one of them is no terminal.
  Terminal();
  // As it was before.
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  // Keys that came within `timeout_s`, or a packet at `other_fd`; empty when neither.
  std::string read(int other_fd, double timeout_s);
  // The terminal was closed.
  bool is_gone() const { return is_gone_; }
  // Never waits: what a terminal that has stopped reading does not take is left out, so that keys still stop the arm.
  void draw(const std::vector<std::string>& lines);
  // As it is now; 80 x 24 where it does not say.
  Size size() const;

 private:
  void put(const std::string& text) const;

  termios before_{};
  int out_ = -1;  // standard output, opened once more: not to wait is a property of an opened file
  bool is_gone_ = false;
};

}  // namespace liana::terminal
