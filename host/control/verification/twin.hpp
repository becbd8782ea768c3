// The twin: a copy of the Controller that runs ahead of the arm (design: what crosses, twin timing).
#pragma once

#include <span>
#include <vector>

#include "host/control/verification/issue_step.hpp"
#include "host/control/verification/twin_snapshot.hpp"

namespace liana::verification {

// What the twin predicts for one candidate. Whoever predicts again and again keeps one: its memory is used anew.
template <class Arm>
struct Prediction {
  std::vector<Outputs<Arm>> ticks;  // the candidate's interval, then the stop after it
  std::size_t command_ticks = 0;    // of these belong to the candidate's interval
  bool comes_to_rest = false;       // within the allowed number of stop ticks
  std::uint64_t faults_before = 0;  // latched at the start
};

template <class Arm>
class Twin {
 public:
  using Command = Telecommand<typename Arm::Setpoint>;

  // Advances a copy through what is already released, then through the candidate, then through the stop that follows
  // when nothing else comes; at most `max_stop_ticks` of it.
  // Cost: a tick of the controller for each of them, and nothing else that counts.
  static void run(const TwinSnapshot<Arm>& start, std::span<const Command> released, const Candidate<Arm>& candidate,
                  std::size_t max_stop_ticks, Prediction<Arm>& prediction);
  // The same with nothing in the place of a candidate of the interval that begins at `first_tick`: what the arm does
  // when that is refused.
  static void stop(const TwinSnapshot<Arm>& start, std::span<const Command> released, std::uint64_t first_tick,
                   std::size_t max_stop_ticks, Prediction<Arm>& prediction);
};

extern template class Twin<cable::CableArm>;
extern template class Twin<serial::SerialArm>;

}  // namespace liana::verification
