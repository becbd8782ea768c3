// The tool at the tip: takes the press rod out of its seat when told to, and says how it went (requirements A7 and
// A53).
#pragma once

#include <optional>
#include <string>

#include "hil/config/scene_config.hpp"
#include "hil/math/vec3.hpp"

namespace liana::bench {

// What lianad passes on from the owner of motion.
struct ToolCommand {
  int number = 0;
  std::string command;   // it knows "repair"
  double begin_s = 0.0;  // bench time at which it begins: certainly not past when the command comes
};

// What it says of a command: it acts, then it is done or has failed.
struct ToolStatus {
  int number = 0;
  std::string phase;   // acting, done, failed
  std::string reason;  // of a failure
  double time_s = 0.0;
};

// What may be wrong with the tool.
struct ToolDefects {
  bool jams = false;    // it fails half-way
  bool silent = false;  // it hears and says nothing
};

class TipTool {
 public:
  static constexpr double kActing_s = 3.0;   // how long a repair takes; assumed
  static constexpr double kReach_m = 0.015;  // the rod's middle is no farther from the tip meanwhile; assumed

  void suffer(const ToolDefects& defects) { defects_ = defects; }
  // A new command; one under way is given up without a word.
  void ask(ToolCommand command);
  // At the start of a slot: acts on the command under way. What it has to say comes out once.
  std::optional<ToolStatus> act(double now_s, const Vec3& tip_m, const Vec3& rod_m);
  // The rod is out of its seat.
  bool has_rod() const { return has_rod_; }
  // The last word on the last command; phase empty before the first.
  const ToolStatus& last() const { return last_; }

 private:
  ToolStatus say(std::string phase, std::string reason, double now_s);
  std::optional<std::string> why_it_fails(const Vec3& tip_m, const Vec3& rod_m) const;

  std::optional<ToolCommand> command_;
  bool acting_ = false;
  bool has_rod_ = false;
  ToolDefects defects_;
  ToolStatus last_;
};

// Reads a message of the topic `tool`; nothing for any other message.
std::optional<ToolCommand> tool_command(const std::string& message);
// The request `tool_report` of docs/reference/api.md.
std::string tool_message(const ToolStatus& report);

}  // namespace liana::bench
