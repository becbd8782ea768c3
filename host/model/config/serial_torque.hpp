// Torque drives of a serial robot: `drives.mode`, `drives.position_gain_per_s` and `force_control` of its table
// (docs/explanation/force-control.md).
#pragma once

#include <array>

#include "host/model/config/field.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::config {

// Names of the gains of a push in tables and requests, in the order of serial::PushGain.
inline constexpr std::array<const char*, serial::kPushGainCount> kPushGainNames{
    "mass_kg",
    "inertia_kgm2",
    "axial_damping_Ns_per_m",
    "lateral_damping_Ns_per_m",
    "turn_damping_Nms_per_rad",
    "force_gain",
    "stiffness_N_per_m",
    "turn_stiffness_Nm_per_rad",
    "approach_m_s",
    "unload_damping_Ns_per_m",
};

// Reads what makes torque drives of the robot's; needs its joints, masses and drives. A table whose drives follow
// positions must not have force_control, one whose drives follow torques must.
void read_torque(const Field& table, SerialRobotConfig& out);

// Refuses buses whose drives are of another mode than the robot's. Throws std::runtime_error.
void check_drive_modes(const SerialRobotConfig& robot, const std::string& file, const BusesConfig& buses);

}  // namespace liana::config
