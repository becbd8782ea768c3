// The goal IK as long work.
#pragma once

#include "host/control/arbiter/long_work.hpp"
#include "host/model/inverse_kinematics/goal_ik.hpp"

namespace liana::arbiter {

class GoalSearch {
 public:
  explicit GoalSearch(const cable::RobotTable& table) : table_(table) {}

  // Begins to look for a solution.
  void start(const solve::GoalIkProblem& problem) {
    work_.start([table = table_, problem] { return solve::solve_goal(table, problem); });
  }
  void forget() { work_.forget(); }
  bool is_wanted() const { return work_.is_wanted(); }
  std::optional<solve::GoalIkResult> take(bool wait) { return work_.take(wait); }

 private:
  cable::RobotTable table_;
  LongWork<solve::GoalIkResult> work_;
};

}  // namespace liana::arbiter
