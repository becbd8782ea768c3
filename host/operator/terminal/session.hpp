// A person who drives the arm from a terminal: keys and states in, requests to lianad out, lines to read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/base/json/json.hpp"
#include "host/operator/terminal/jog.hpp"
#include "host/operator/terminal/status_line.hpp"

namespace liana::terminal {

// No input or output of its own; times are of one clock that never goes back [s].
class Session {
 public:
  static constexpr double kPeriod_s = 1.0 / 60.0;  // between two goals
  static constexpr double kTimeToLive_s = 0.3;     // the arm holds when goals stop coming

  // `welcome`: what lianad answered to our hello as `name`.
  Session(std::string name, const Json& welcome);

  // What a key asks lianad for; empty for keys that change only what is here.
  std::vector<Json> press(const Key& key, double now_s);
  // A gamepad is held and leans this way; nothing: it is let go, or there is none.
  void lean(const std::optional<Direction>& direction) { leant_ = direction; }
  // A line for the person, until another one comes.
  void say(const std::string& text) { said_ = text; }
  // Every kPeriod_s: the next goal while a key that jogs or a gamepad is held, and one hold when it is let go.
  std::vector<Json> pass(double now_s);
  // A packet of lianad.
  void hear(const Json& message);

  bool wants_end() const { return wants_end_; }
  // lianad has said that it ends.
  bool is_over() const { return state_.value("stopping", false); }
  // What is shown on a terminal of this size.
  std::vector<std::string> lines(Size size) const;

 private:
  bool owns_motion() const { return state_.value("owner", "") == name_; }
  // Why nothing would move now; empty: it would.
  std::string why_still() const;
  Direction wanted(double now_s) const;
  std::optional<Pose> commanded() const;
  Json asked(Json request);
  void change_speed(double factor);

  std::string name_, robot_;
  JogLimits limits_;
  JogSpeed speed_;
  HeldKeys held_;
  std::optional<Direction> leant_;
  Json state_ = Json::object();
  std::optional<Pose> goal_;  // while jogging
  double goal_s_ = 0.0;       // when it was asked for
  int last_id_ = 0;
  std::string said_;  // what became of what was asked last
  bool wants_end_ = false;
};

}  // namespace liana::terminal
