// The end effector: closes on the payload's grapple on the command "grapple", opens on "release".
#pragma once

#include <optional>
#include <string>

#include "hil/arm/tip_tool.hpp"
#include "hil/math/vec3.hpp"

namespace liana::bench {

// What the end effector has before it.
struct GrappleObservation {
  Pose grapple_in_tip{};  // of the payload
  bool has_payload = false;
  bool locked = false;  // the adapter holds the payload for good
};

class Grapple {
 public:
  static constexpr double kActing_s = 3.0;              // to close or open; assumed, as all of these
  static constexpr double kReach_m = 0.020;             // the grapple's origin is no farther from the tip's meanwhile
  static constexpr double kTilt_rad = 0.0349065850399;  // 2 deg: nor turned by more

  void suffer(const ToolDefects& defects) { defects_ = defects; }
  // A new command; one under way is given up without a word.
  void ask(ToolCommand command);
  // At the start of a slot: acts on the command under way. What it has to say comes out once; phase "done" means that
  // it has closed or opened now.
  std::optional<ToolStatus> act(double now_s, const GrappleObservation& sight);
  // The command that the last report is about.
  const std::string& command() const { return name_; }
  // The last word on the last command; phase empty before the first.
  const ToolStatus& last() const { return last_; }

 private:
  ToolStatus say(std::string phase, std::string reason, double now_s);
  std::optional<std::string> why_it_fails(const GrappleObservation& sight) const;

  std::optional<ToolCommand> asked_;
  std::string name_;
  bool acting_ = false;
  ToolDefects defects_;
  ToolStatus last_;
};

}  // namespace liana::bench
