// Progress of a run on standard error: a line per step; on a terminal also a live line.
#pragma once

#include <cstdint>
#include <string>

#include "host/base/json/json_fwd.hpp"

namespace liana::launcher {

class Progress {
 public:
  Progress();
  // Takes in one state message of lianad.
  void show(const Json& state);
  // A line of its own.
  void say(const std::string& text);

 private:
  void show_live(const Json& state);
  void clear_live();

  bool terminal_;
  bool live_ = false;
  int step_index_ = 0;
  std::int64_t step_entry_ = 0;  // a step that comes again has the same index
  std::string phase_;
  double next_live_s_ = 0.0;
};

}  // namespace liana::launcher
