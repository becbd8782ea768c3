// The arm and scene of all closed-loop tests, read from the same JSON as the bench reads.
#pragma once

#include <string>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/pose.hpp"
#include "host/model/config/config.hpp"

namespace liana::closed_loop {

// What the host knows of the arm, and the core's table of it; `physics` chooses the friction that the core is told.
// Read once per process.
const config::RobotConfig& robot(const std::string& physics = "nominal");
const cable::RobotParams& robot_table(const std::string& physics = "nominal");
// lab_1g, mounted so that gravity pulls that way in its base frame. Read once per process.
cable::RobotParams lab_table(const Vec3& gravity_m_s2);
// feeder, an arm on a base that feeds. Read once per process.
const cable::RobotParams& feeder_table();
// How users mount it: lying, hanging, standing, and lying with its back down.
inline constexpr double kEarth_m_s2 = 9.80665;
inline constexpr Vec3 kLying_m_s2{0.0, 0.0, -kEarth_m_s2}, kHanging_m_s2{kEarth_m_s2, 0.0, 0.0},
    kUpsideDown_m_s2{0.0, 0.0, kEarth_m_s2}, kStanding_m_s2{-kEarth_m_s2, 0.0, 0.0};
struct LabMounting {
  const char* name;
  Vec3 gravity_m_s2;
};
inline constexpr LabMounting kLabMountings[] = {{"lying", kLying_m_s2},
                                                {"hanging", kHanging_m_s2},
                                                {"upside down", kUpsideDown_m_s2},
                                                {"standing", kStanding_m_s2}};
// Angles of one of its named poses [rad].
cable::ThetaVector lab_pose_rad(const std::string& name);
// Angles of a named pose of the robot [rad]; throws std::out_of_range for an unknown name.
cable::ThetaVector named_pose_rad(const std::string& name);
// Tip pose at a named pose, by the core's kinematics.
Pose tip_at(const std::string& pose_name);
// The scene, read once per process.
const config::SceneConfig& scene();

// Largest |a - b| over all angles [deg].
double largest_difference_deg(const cable::ThetaVector& a_rad, const cable::ThetaVector& b_rad);
// Distance between two positions [mm].
double distance_mm(const Vec3& a_m, const Vec3& b_m);
// The minimum-jerk share of the way at share `x` of the time, 0..1.
double minimum_jerk(double x);

// Prints one measured figure and keeps it in the test's XML record.
void measured(const std::string& what, double value, const std::string& unit);

}  // namespace liana::closed_loop
