// Drives as the twin imagines them: they do what they are told, one tick late.
#pragma once

#include "firmware_like/controller_io.hpp"

namespace liana {

class IdealDrives {
 public:
  // Starts from what the real drives reported last and what they were told last.
  IdealDrives(const RobotTable& table, const Inputs& last_inputs, const Outputs& last_outputs);
  // The feedback for the next tick: the state, position and tension that the last commands asked for.
  Inputs next_inputs(std::uint64_t tick) const;
  // Takes the commands of a tick.
  void command(const Outputs& outputs) { told_ = outputs; }

 private:
  DriveFeedback feedback_of(std::size_t drive) const;

  const RobotTable& table_;
  Inputs last_;
  Outputs told_;
};

}  // namespace liana
