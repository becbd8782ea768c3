// The goal IK as long work.
#pragma once

#include "host/control/arbiter/background_job.hpp"
#include "host/model/inverse_kinematics/goal_ik.hpp"

namespace liana::arbiter {

class GoalSearch {
 public:
  explicit GoalSearch(const cable::RobotParams& table) : table_(table) {}

  // Begins to look for a solution.
  void start(const inverse_kinematics::GoalIkProblem& problem) {
    work_.start([table = table_, problem] { return inverse_kinematics::solve_goal(table, problem); });
  }
  void forget() { work_.forget(); }
  bool is_wanted() const { return work_.is_wanted(); }
  std::optional<inverse_kinematics::GoalIkResult> take(bool wait) { return work_.take(wait); }

 private:
  cable::RobotParams table_;
  BackgroundJob<inverse_kinematics::GoalIkResult> work_;
};

}  // namespace liana::arbiter
