#include "host/arbiter/goal_search.hpp"

#include <chrono>
#include <system_error>

namespace liana {

namespace {

bool is_there(const std::future<solve::GoalIkResult>& result) {
  return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

}  // namespace

void GoalSearch::start(const solve::GoalIkProblem& problem) {
  waiting_ = problem;
  wanted_ = true;
  launch(false);
}

void GoalSearch::forget() {
  waiting_.reset();
  wanted_ = false;
}

std::optional<solve::GoalIkResult> GoalSearch::take(bool wait) {
  if (!wanted_) return std::nullopt;
  launch(wait);
  if (waiting_ || (!wait && !is_there(running_))) return std::nullopt;
  wanted_ = false;
  return running_.get();
}

// Assigning to a future that runs would wait for its end. Where the system gives no thread, who waits computes itself,
// and who does not tries again.
void GoalSearch::launch(bool wait) {
  if (!waiting_ || (!wait && running_.valid() && !is_there(running_))) return;
  const auto solve = [this, problem = *waiting_] { return solve::solve_goal(table_, problem); };
  try {
    running_ = std::async(std::launch::async, solve);
  } catch (const std::system_error&) {
    if (!wait) return;
    running_ = std::async(std::launch::deferred, solve);
  }
  waiting_.reset();
}

}  // namespace liana
