// The controller of the arm that carries, as far as this bench has one: on the command "carry" it turns the joints that
// were locked, all of them together, from where the payload is fetched to where it is installed, and locks them there.
#pragma once

#include <optional>
#include <string>

#include "hil/arm/tip_tool.hpp"

namespace liana::bench {

// What it knows of the arm that it carries, and of itself.
struct CarryObservation {
  double takes_s = 0.0;     // for the whole way; 0: there is no way to go
  bool arm_rests = false;   // the arm that is carried
  bool has_torque = false;  // it, in all its drives; the line that tells so is a wire, as that of an emergency stop
};

class Carrier {
 public:
  void suffer(const ToolDefects& defects) { defects_ = defects; }
  // The command "carry"; one under way is given up without a word.
  void ask(ToolCommand command);
  // At the start of a slot: goes on. What it has to say comes out once, as of the end effector (grapple.hpp).
  std::optional<ToolStatus> act(double now_s, const CarryObservation& sight);
  // How much of the way its joints are told to have gone; 1: locked at its end.
  double share() const { return share_; }
  const ToolStatus& last() const { return last_; }

 private:
  // What is under way.
  struct Way {
    double from;    // share when it began
    double gone_s;  // of its time, which stands still when it has stopped
    double at_s;    // when that was so
    bool had_torque;
    std::optional<double> stops_since_s;
    std::string why;  // it stops
  };

  ToolStatus say(std::string phase, std::string reason, double now_s);
  std::optional<ToolStatus> begin(double now_s, const CarryObservation& sight);
  void go_on(double now_s, double takes_s);

  std::optional<ToolCommand> asked_;
  std::optional<Way> way_;
  ToolDefects defects_;
  ToolStatus last_;
  double share_ = 0.0;
};

}  // namespace liana::bench
