// Drives as the twin imagines them: they do what they are told, one tick late.
#pragma once

#include "firmware_like/cable_controller.hpp"

namespace liana {

class IdealDrives {
 public:
  // Starts from what the real drives reported last and what they were told last.
  IdealDrives(const cable::RobotTable& table, const cable::Inputs& last_inputs, const cable::Outputs& last_outputs);
  // The feedback for the next tick: the state, position and tension that the last commands asked for.
  cable::Inputs next_inputs(std::uint64_t tick) const;
  // Takes the commands of a tick.
  void command(const cable::Outputs& outputs) { told_ = outputs; }

 private:
  DriveFeedback feedback_of(std::size_t drive) const;

  const cable::RobotTable& table_;
  cable::Inputs last_;
  cable::Outputs told_;
};

}  // namespace liana
