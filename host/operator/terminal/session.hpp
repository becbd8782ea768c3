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

  static constexpr double kMaxSilence_s = 1.0;  // of lianad: no state, or no answer to a stop

  // `welcome`: what lianad answered to our hello as `name`, now.
  Session(std::string name, const Json& welcome, double now_s);

  // What a key asks lianad for; empty for keys that change only what is here. While lianad is silent one stop is sent
  // and nothing else: nothing may pile up that it would do when it goes on.
  std::vector<Json> press(const Key& key, double now_s);
  // A gamepad is held and leans this way; nothing: it is let go, or there is none.
  void lean(const std::optional<Direction>& direction) { leant_ = direction; }
  // A line for the person, until another one comes.
  void say(const std::string& text) { said_ = text; }
  // Every kPeriod_s: the next goal while a key that jogs or a gamepad is held, and one hold when it is let go.
  std::vector<Json> pass(double now_s);
  // A packet of lianad.
  void hear(const Json& message, double now_s);

  bool wants_end() const { return wants_end_; }
  // lianad has said that it ends.
  bool is_over() const { return state_.value("stopping", false); }
  // What is shown on a terminal of this size.
  std::vector<std::string> lines(Size size, double now_s) const;

 private:
  bool owns_motion() const { return state_.value("owner", "") == name_; }
  // For how long lianad has been silent, once that is too long; else 0. In fast time it may stand still for long.
  double silent_s(double now_s) const;
  // The same of its answer to a stop.
  double unconfirmed_s(double now_s) const;
  // Why nothing would move now; empty: it would.
  std::string why_still() const;
  Json request_of(const Key& key);
  void hear_answer(const Json& answer);
  Direction wanted(double now_s) const;
  std::optional<Pose> commanded() const;
  Json asked(Json request);
  void change_speed(double factor);

  // An emergency stop that lianad has not answered yet.
  struct Stop {
    int id = 0;
    double since_s = 0.0;  // when the first one was asked for
  };

  std::string name_, robot_;
  bool is_fast_;    // virtual time, which may wait for others
  double heard_s_;  // when the last state came
  JogLimits limits_;
  JogSpeed speed_;
  HeldKeys held_;
  std::optional<Direction> leant_;
  Json state_ = Json::object();
  std::optional<Pose> goal_;  // while jogging
  double goal_s_ = 0.0;       // when it was asked for
  int last_id_ = 0;
  std::optional<Stop> stop_;
  int take_id_ = 0;        // of the last request for motion
  std::string take_from_;  // owner that the next one names: lianad has refused to take motion from it without
  std::string said_;       // what became of what was asked last
  bool wants_end_ = false;
};

}  // namespace liana::terminal
