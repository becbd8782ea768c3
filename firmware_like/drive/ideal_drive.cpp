#include "firmware_like/drive/ideal_drive.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace liana {
namespace {

struct Answer {
  std::uint16_t controlword;
  DriveState state;
  std::uint16_t statusword;
};

// Statuswords of CiA 402 with voltage on.
constexpr std::array kAnswers{Answer{kEnableOperation, DriveState::kOperationEnabled, 0x1237},
                              Answer{kSwitchOn, DriveState::kSwitchedOn, 0x0233},
                              Answer{kShutdown, DriveState::kReadyToSwitchOn, 0x0231},
                              Answer{kQuickStopCommand, DriveState::kQuickStopActive, 0x0217},
                              Answer{kDisableVoltage, DriveState::kSwitchOnDisabled, 0x0250}};

}  // namespace

std::uint16_t statusword_after(std::uint16_t controlword, std::uint16_t reported) noexcept {
  for (const Answer& row : kAnswers) {
    if ((controlword & 0x0F) == row.controlword) return decode(reported) == row.state ? reported : row.statusword;
  }
  return reported;
}

DriveFeedback ideal_torque_feedback(const DriveFeedback& last, const DriveCommand& told, std::int32_t target_before,
                                    std::int16_t torque_permille) noexcept {
  DriveFeedback feedback = ideal_feedback(last, told, torque_permille);
  if (decode(feedback.statusword) != DriveState::kOperationEnabled) return feedback;
  const std::int64_t moved = std::int64_t{told.target_counts} - target_before;
  const std::int64_t caught_up = (std::int64_t{target_before} - last.position_counts) / kIdealCatchUp;
  using Counts = std::numeric_limits<std::int32_t>;
  const std::int64_t there = last.position_counts + moved + caught_up;
  feedback.position_counts =
      static_cast<std::int32_t>(std::clamp(there, std::int64_t{Counts::min()}, std::int64_t{Counts::max()}));
  return feedback;
}

}  // namespace liana
