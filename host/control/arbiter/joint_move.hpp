// A way of moving: all joints together from where they stand to a goal, on one time law. It begins from rest: an arm
// that moves stops first. Then the whole way is looked at: a goal that cannot be reached so is told at once. What was
// refused goes on from rest, half as fast, and comes to its speed again on the way; it is given up after four refusals
// at one place.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "host/control/arbiter/another_try.hpp"
#include "host/control/arbiter/arm_traits.hpp"
#include "host/control/arbiter/background_job.hpp"
#include "host/control/timing/trajectory_timing.hpp"

namespace liana::arbiter {

template <class Arm>
class JointMove {
 public:
  static constexpr bool kIsPlanned = true;
  using Table = typename Arm::Table;

  // Duration such that no joint passes `rate_rad_s`, its own rate and its acceleration for moves, and the tip not its
  // speed limit. `table` has to outlive this. Cost: 100 forward kinematics.
  JointMove(const Table& table, const Joints<Arm>& from_rad, const Joints<Arm>& to_rad, double rate_rad_s,
            const motion::Swings& swings = {});

  // Why the arm must not go straight from here to there; empty: it may. Called in another thread.
  using Look = std::function<std::string(const Joints<Arm>& from_rad, const Joints<Arm>& to_rad)>;
  using Work = BackgroundJob<std::string>;
  // Before the arm moves, `look` is called in `work`, which has to outlive this.
  void look_first(Work& work, SearchResult taken, Look look);

  double duration_s() const { return law_.duration_s(); }
  // Joints at a time since the start.
  Joints<Arm> at(double time_s) const;

  Goal<Arm> next(const liana::Outputs<Arm>& now);
  // The time is up and the arm, which follows, is at rest.
  bool is_over() const { return is_over_; }
  bool refused();
  // Why it does not begin; empty: it may, or is still looked at.
  const std::string& refusal() const { return refusal_; }

 private:
  void plan(const Joints<Arm>& from_rad);
  bool is_looked_at(const Joints<Arm>& from_rad);

  const Table& table_;
  double rate_rad_s_;
  motion::Swings swings_;
  Joints<Arm> from_rad_, to_rad_;
  double interval_s_;
  motion::TrajectoryTiming law_;
  double time_s_ = 0.0;  // of the law
  double pace_ = 1.0;    // of that, in a second
  bool is_over_ = false, has_begun_ = false;
  AnotherTry again_;
  Work* work_ = nullptr;
  SearchResult taken_ = SearchResult::kInItsInterval;
  Look look_;  // until it has been asked
  std::string refusal_;
};

}  // namespace liana::arbiter
