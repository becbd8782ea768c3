// What the owner's setpoints tell of themselves: their number, the client's clock, how long they live; and how far the
// goals of a stream may be apart. Time is arm time, counted in ticks [s].
#pragma once

#include <cstdint>
#include <optional>

#include "firmware_like/math/pose.hpp"
#include "host/api/server/arguments.hpp"

namespace liana::server {

class SetpointStream {
 public:
  explicit SetpointStream(const api::RequestBounds& bounds) : bounds_(bounds) {}

  // Motion has another owner: numbers and clock begin anew.
  void restart() { *this = SetpointStream(bounds_); }
  // Throws RequestError about a setpoint that comes at `now_s`: `refused` when its sequence does not grow, its clock
  // goes back, or it comes later than its ttl_s; `out_of_range` when the goal of a stream is farther than kJump_s of
  // the tip's limits both from the goal before it and from `tip`, where the tip is commanded.
  void check(const api::RequestRow& row, const api::Arguments& setpoint, double now_s, const Pose& tip) const;
  // It was accepted. One that is no goal of a stream ends the stream.
  void note(const api::RequestRow& row, const api::Arguments& setpoint, double now_s);
  // Nobody streams any more.
  void end();
  // The time to live of the stream's last goal when it will have passed by `next_s`, the time of the next look, and the
  // tip has not reached that goal: the owner stands still. The stream is over then, reached or not.
  std::optional<double> overdue(double next_s, const Pose& tip);

 private:
  void check_stamp(const api::Arguments& setpoint, double now_s) const;
  void check_jump(const Pose& goal, const Pose& tip) const;

  api::RequestBounds bounds_;
  std::int64_t sequence_ = 0;      // of the last setpoint that had one
  std::optional<double> clock_s_;  // the client's, of the last setpoint that had one
  double lag_s_ = 0.0;             // arm time less the client's clock, of the quickest setpoint lately
  double noted_s_ = 0.0;           // when that setpoint came
  std::optional<Pose> goal_;       // of the stream; nothing: there is none
  double goal_s_ = 0.0;            // when that goal came
  std::optional<double> ttl_s_;    // of that goal
};

}  // namespace liana::server
