// When a run of lianad ends by itself: after its mission, once the arm rests, or when a client asks for it.
#pragma once

#include <cstdint>

#include "firmware_like/controller_io.hpp"

namespace liana::server {

enum class RunPhase : std::uint8_t {
  kRunning,
  kAskedToEnd,    // a client wants the end
  kAfterMission,  // the mission is gone: what a failure leads to still belongs to the run
  kStopping       // the arm is stopped; over when its drives are off
};

class RunLifecycle {
 public:
  RunLifecycle(double tick_s, std::uint64_t interval_ticks) : tick_s_(tick_s), interval_ticks_(interval_ticks) {}

  // The end after a mission comes before the one that a client asks for: its (repeatable) time counts.
  void mission_ends(std::uint64_t tick);
  void ask_to_end();
  // Why the run has to stop now; nothing: it goes on. Once per interval.
  const char* why_to_stop(std::uint64_t tick, const CycleOutputs& outputs);
  // False: it stops already.
  bool stop(std::uint64_t tick);

  bool is_stopping() const { return phase_ == RunPhase::kStopping; }
  // Drives are off and clients know it, or too much time has passed.
  bool is_over(std::uint64_t tick, const CycleOutputs& outputs) const;
  // Otherwise clients may still want to read the last state.
  bool was_asked_to_end() const { return was_asked_; }

 private:
  double since_s(std::uint64_t tick, std::uint64_t then) const { return static_cast<double>(tick - then) * tick_s_; }

  double tick_s_;
  std::uint64_t interval_ticks_;
  RunPhase phase_ = RunPhase::kRunning;
  bool was_asked_ = false;
  std::uint64_t since_tick_ = 0;  // of the end of the mission, or of the stop
  std::uint64_t moved_tick_ = 0;  // the last after the mission's end in which the arm moved
};

}  // namespace liana::server
