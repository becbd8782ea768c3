// The goal IK in a thread of its own, one job at a time: a search of some milliseconds, or of many on a slow machine,
// must not keep a stop from being read.
#pragma once

#include <future>
#include <optional>

#include "host/solve/goal_ik.hpp"

namespace liana {

class GoalSearch {
 public:
  explicit GoalSearch(const cable::RobotTable& table) : table_(table) {}

  // Begins to look for a solution; an earlier one is not wanted any more, and what it still computes delays this one.
  void start(const solve::GoalIkProblem& problem);
  // Nobody wants the result any more.
  void forget();
  // Started, and neither taken nor forgotten.
  bool is_wanted() const { return wanted_; }
  // The result, once, as soon as it is there; with `wait` it is waited for.
  std::optional<solve::GoalIkResult> take(bool wait);

 private:
  void launch(bool wait);

  cable::RobotTable table_;
  std::optional<solve::GoalIkProblem> waiting_;  // until the job before it, which nobody wants, has ended
  bool wanted_ = false;
  std::future<solve::GoalIkResult> running_;  // last: its destructor waits for the thread, which reads the table
};

}  // namespace liana
