// The parts of a robot table, read one by one; robot.cpp puts them together.
#pragma once

#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/field.hpp"

namespace liana::config {

// Degrees of an angle that came from degrees: 15 again, and not 14.999999999999998.
inline double rounded_deg(double angle_rad) { return std::round(1e9 * angle_rad / kDegree) / 1e9; }

// Segments, module and cable geometry; refuses more than the compiled capacity by name.
void read_arm(const Field& table, RobotConfig& out);

// Cable stiffness, friction for the named physics, tension limits in their order.
void read_cables(const Field& table, const std::string& physics, RobotConfig& out);

// Drum, encoder, identity, direction and zeros of every drive; needs read_arm first.
void read_drives(const Field& table, RobotConfig& out);

// What object 0x1018 of every drive must say.
DriveIdentity read_identity(const Field& field);

// Optional serial numbers, each once, or twice in a row: axes of a node; empty: what is not known is not checked.
std::vector<std::uint32_t> read_serials(const Field& drives, std::size_t count);

// How old a calibration may be; a year where the table does not say.
std::int32_t read_calibration_days(const Field& drives);

// Drives are the axes of nodes 1, 2, ... (docs/reference/drives.md): throws unless every drive is on a bus, no bus has
// a node without a drive, and serial numbers are those of nodes.
void check_nodes(const std::string& robot, std::int32_t drives, const std::vector<std::uint32_t>& serials,
                 const std::string& file, const BusesConfig& buses);

// Motion limits.
void read_limits(const Field& field, cable::MotionLimits& limits);

// The optional start_pose: one of the named poses; empty where the table does not say.
std::string read_start_pose(const Field& table, const std::map<std::string, std::vector<double>>& named_poses_deg);

// The optional jig_poses: two or more of the named poses, each once; empty where the table does not say.
std::vector<std::string> read_jig_poses(const Field& table,
                                        const std::map<std::string, std::vector<double>>& named_poses_deg);

// A cable robot's table by itself, with nominal friction and without what buses decide (tick, T_c).
RobotConfig parse_robot_alone(const std::string& text, const std::string& file);

// Named poses within the theta limits; "zero" must be there.
void read_named_poses(const Field& field, RobotConfig& out);

}  // namespace liana::config
