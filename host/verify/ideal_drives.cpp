#include "host/verify/ideal_drives.hpp"

#include <cmath>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/math/convert.hpp"

namespace liana {

namespace {

// Statuswords of CiA 402 with voltage on; a drive that is already in the state keeps the word it reported.
std::uint16_t statusword_for(std::uint16_t controlword, std::uint16_t reported) {
  struct Row {
    std::uint16_t controlword;
    DriveState state;
    std::uint16_t statusword;
  };
  static constexpr Row kRows[] = {{kEnableOperation, DriveState::kOperationEnabled, 0x1237},
                                  {kSwitchOn, DriveState::kSwitchedOn, 0x0233},
                                  {kShutdown, DriveState::kReadyToSwitchOn, 0x0231},
                                  {kQuickStopCommand, DriveState::kQuickStopActive, 0x0217},
                                  {kDisableVoltage, DriveState::kSwitchOnDisabled, 0x0250}};
  for (const Row& row : kRows) {
    if ((controlword & 0x0F) == row.controlword) return decode(reported) == row.state ? reported : row.statusword;
  }
  return reported;
}

}  // namespace

IdealDrives::IdealDrives(const RobotTable& table, const Inputs& last_inputs, const Outputs& last_outputs)
    : table_(table), last_(last_inputs), told_(last_outputs) {}

DriveFeedback IdealDrives::feedback_of(std::size_t drive) const {
  DriveFeedback feedback = last_.drive[drive];
  feedback.statusword = statusword_for(told_.drive[drive].controlword, feedback.statusword);
  if (decode(feedback.statusword) == DriveState::kOperationEnabled) {
    feedback.position_counts = told_.drive[drive].target_counts;
    const double permille = told_.tension_plan_N[drive] / table_.drive[drive].newtons_per_permille;
    feedback.torque_permille = narrow<std::int16_t>(to_counts(permille).value);
  }
  feedback.feedback_age_ticks =
      1;  // imagined from the last tick: it says nothing about the cables (safety/cable_watch.hpp)
  feedback.heartbeat_age_ticks = feedback.emergency_code = 0;
  return feedback;
}

Inputs IdealDrives::next_inputs(std::uint64_t tick) const {
  Inputs inputs;
  inputs.tick = tick;
  const auto drives = static_cast<std::size_t>(table_.cable_count());
  for (std::size_t i = 0; i < drives; ++i) inputs.drive[i] = feedback_of(i);
  return inputs;
}

}  // namespace liana
