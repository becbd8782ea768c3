// The parts of a robot table, read one by one; robot.cpp puts them together.
#pragma once

#include "host/config/config.hpp"
#include "host/config/field.hpp"

namespace liana {

constexpr double kRadPerDeg = 3.14159265358979323846 / 180.0;

// Segments, module and cable geometry; refuses more than the compiled capacity by name.
void read_arm(const Field& table, RobotConfig& out);

// Cable stiffness, friction for the named physics, tension limits in their order.
void read_cables(const Field& table, const std::string& physics, RobotConfig& out);

// Drum, encoder, identity, direction and zeros of every drive; needs read_arm first.
void read_drives(const Field& table, RobotConfig& out);

// Motion limits.
void read_limits(const Field& field, cable::MotionLimits& limits);

// Named poses within the theta limits; "zero" must be there.
void read_named_poses(const Field& field, RobotConfig& out);

}  // namespace liana
