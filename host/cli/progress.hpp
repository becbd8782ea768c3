// Progress of a run on standard error: a line per step; on a terminal also a live line.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace liana {

class Progress {
 public:
  Progress();
  // Takes in one state message of lianad.
  void show(const nlohmann::json& state);
  // A line of its own.
  void say(const std::string& text);

 private:
  void show_live(const nlohmann::json& state);
  void clear_live();

  bool terminal_;
  bool live_ = false;
  int step_index_ = 0;
  std::string phase_;
  double next_live_s_ = 0.0;
};

}  // namespace liana
