// A position-controlled drive as the twin imagines it: it does what it is told, one tick late.
#pragma once

#include <cstdint>

#include "firmware_like/drive/drive_io.hpp"

namespace liana {

// What a drive that reported `last` and was then `told` something reports a tick later. While it is enabled it stands
// at its target and shows `torque_permille`. Its feedback is one tick old: it is imagined, and proves nothing about the
// arm behind it.
DriveFeedback ideal_feedback(const DriveFeedback& last, const DriveCommand& told,
                             std::int16_t torque_permille) noexcept;

}  // namespace liana
