// The way to the best shape of all: a search for it, and then its nodes as targets, until they are there.
#pragma once

#include <cstdint>

#include "firmware_like/cable_controller.hpp"
#include "host/control/arbiter/goal_search.hpp"

namespace liana::arbiter {

class ShapeTransition {
 public:
  ShapeTransition(const cable::RobotParams& table, SearchResult taken) : table_(table), taken_(taken), search_(table) {}

  // Forgets what was looked for before.
  void look_for(const inverse_kinematics::GoalIkProblem& problem);
  void forget();
  // A shape is looked for (the arm holds meanwhile), or the nodes are on their way to the one that was found.
  bool is_under_way() const { return search_.is_wanted() || leads(); }
  // Targets to give instead of the wished ones while it is under way; none where no solution was found.
  const cable::NodeTargets& nodes() const { return nodes_; }

  // Once per command interval, first: what a search has come to.
  enum class Found { kNothing, kNow, kNotYet };
  Found look();
  // Then, where the arm does not wait for it: true when the lead has just ended, with the nodes there or coming no
  // nearer.
  bool ends(const cable::Outputs& now);
  // Something else was asked of the arm: whether nodes come nearer shows some intervals later.
  void ask_anew() { intervals_ = 0; }

 private:
  bool leads() const;
  bool is_there(const cable::Outputs& now) const;

  cable::RobotParams table_;
  SearchResult taken_;
  GoalSearch search_;
  cable::NodeTargets nodes_{};
  std::int32_t intervals_ = 0;  // since something was asked of the arm
};

}  // namespace liana::arbiter
