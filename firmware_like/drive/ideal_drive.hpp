// A drive as the twin imagines it: it does what it is told, one tick late.
#pragma once

#include <cstdint>

#include "firmware_like/drive/drive_io.hpp"

namespace liana {

constexpr std::int64_t kIdealCatchUp = 20;  // one of so many parts in a tick

// What a drive that reported `last` and was then `told` something reports a tick later. While it is enabled it stands
// at its target and shows `torque_permille`. Its feedback is one tick old: it is imagined, and proves nothing about the
// arm behind it.
DriveFeedback ideal_feedback(const DriveFeedback& last, const DriveCommand& told,
                             std::int16_t torque_permille) noexcept;

// The same of a torque drive, whose joint may be well behind its target: it moves as the target has moved since
// `target_before`, and takes kIdealCatchUp of what it is behind. At once there it would seem to jump.
DriveFeedback ideal_torque_feedback(const DriveFeedback& last, const DriveCommand& told, std::int32_t target_before,
                                    std::int16_t torque_permille) noexcept;

}  // namespace liana
