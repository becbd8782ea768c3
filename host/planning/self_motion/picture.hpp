// Deflection along a self-motion as a picture.
#pragma once

#include <string>

#include "host/planning/self_motion/self_motion.hpp"

namespace liana::self_motion {

// SVG text: how far the tip gives way under 1 N along its z axis, the axis of insertion, over the arm angle; the
// stiffest and the softest configuration are marked.
std::string picture_of(const std::string& robot, const SelfMotion& motion);

// Index of the configuration in which the tip goes least far under that force, or farthest; `way` is never empty.
std::size_t stiffest(const SelfMotion& motion);
std::size_t softest(const SelfMotion& motion);

}  // namespace liana::self_motion
