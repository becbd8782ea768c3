// Work in a thread of its own, one job at a time: what takes milliseconds here, or seconds on a slow machine, must not
// keep a stop from being read.
#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <optional>
#include <system_error>

namespace liana::arbiter {

// When the result of long work is taken: in virtual time at the end of the interval that asked for it, so that runs
// repeat bit for bit; in real time in the first interval that finds it there.
enum class SearchResult { kInItsInterval, kWhenThere };

template <class Result>
class BackgroundJob {
 public:
  // Begins a job, which may only use what it holds itself; an earlier one is not wanted any more, and what it still
  // computes delays this one.
  void start(std::function<Result()> job) {
    waiting_ = std::move(job);
    wanted_ = true;
    launch(false);
  }
  // Nobody wants the result any more.
  void forget() {
    waiting_ = nullptr;
    wanted_ = false;
  }
  // Started, and neither taken nor forgotten.
  bool is_wanted() const { return wanted_; }
  // The result, once, as soon as it is there; with `wait` it is waited for. Throws what the job has thrown.
  std::optional<Result> take(bool wait) {
    if (!wanted_) return std::nullopt;
    launch(wait);
    if (waiting_ || (!wait && !is_there())) return std::nullopt;
    wanted_ = false;
    return running_.get();
  }

 private:
  bool is_there() const { return running_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }

  // Assigning to a future that runs would wait for its end. Where the system gives no thread, who waits computes
  // itself, and who does not tries again.
  void launch(bool wait) {
    if (!waiting_ || (!wait && running_.valid() && !is_there())) return;
    try {
      running_ = std::async(std::launch::async, waiting_);
    } catch (const std::system_error&) {
      if (!wait) return;
      running_ = std::async(std::launch::deferred, waiting_);
    }
    waiting_ = nullptr;
  }

  std::function<Result()> waiting_;  // until the job before it, which nobody wants, has ended
  bool wanted_ = false;
  std::future<Result> running_;  // last: its destructor waits for the thread
};

}  // namespace liana::arbiter
