// A drive as the twin imagines it: it does what it is told, one tick late.
#pragma once

#include <cstdint>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/drive/drive_io.hpp"

namespace liana {

constexpr std::int64_t kIdealCatchUp = 20;  // one of so many parts in a tick

// Statusword of the state that a controlword leads to; a drive that is there already keeps the word it `reported`.
std::uint16_t statusword_after(std::uint16_t controlword, std::uint16_t reported) noexcept;
inline std::uint16_t ideal_statusword(std::uint16_t controlword, std::uint16_t reported) noexcept {
  const bool goes_on = (controlword & 0x0F) == kEnableOperation && decode(reported) == DriveState::kOperationEnabled;
  return goes_on ? reported : statusword_after(controlword, reported);
}

// What a drive that reported `last` and was then `told` something reports a tick later. While it is enabled it stands
// at its target and shows `torque_permille`. Its feedback is one tick old: it is imagined, and proves nothing about the
// arm behind it.
inline DriveFeedback ideal_feedback(const DriveFeedback& last, const DriveCommand& told,
                                    std::int16_t torque_permille) noexcept {
  DriveFeedback feedback = last;
  feedback.statusword = ideal_statusword(told.controlword, last.statusword);
  if (decode(feedback.statusword) == DriveState::kOperationEnabled) {
    feedback.position_counts = told.target_counts;
    feedback.torque_permille = torque_permille;
  }
  feedback.feedback_age_ticks = 1;
  feedback.heartbeat_age_ticks = feedback.emergency_code = 0;
  return feedback;
}

// The same of a torque drive, whose joint may be well behind its target: it moves as the target has moved since
// `target_before`, and takes kIdealCatchUp of what it is behind. At once there it would seem to jump.
DriveFeedback ideal_torque_feedback(const DriveFeedback& last, const DriveCommand& told, std::int32_t target_before,
                                    std::int16_t torque_permille) noexcept;

}  // namespace liana
