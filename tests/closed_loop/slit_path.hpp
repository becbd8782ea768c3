// The whole way of the slit crossing as tip targets, without people and cameras (mission, A7 and A8): what the core
// and the arm make of it.
#pragma once

#include <string>
#include <vector>

#include "arm_under_control.hpp"

namespace liana::closed_loop {

// One stretch of the way.
struct Leg {
  std::string name;
  Pose goal_in_base{};
  double seconds = 0.0;
  std::uint32_t held_mask = 0;  // thetas that go to 0 and stay there
  double speed_m_s = 0.0;       // tip limit
  bool steers_shape = false;    // node 3 goes to where it is at panel edge
};

// Prepare to press rod: free space, segment 5 planar, into the slit, segments 4 and 5 planar, to the rod.
std::vector<Leg> slit_legs();

// Node 3 (the end of segment 3) at the named pose panel_edge, base frame [m].
Vec3 node_3_at_panel_edge_m();

// Setpoint at `share` of the time of a leg that started at tip pose `from` with node 3 at `node_from_m`.
cable::Setpoint leg_setpoint(const Leg& leg, const Pose& from, const Vec3& node_from_m, double share);

// What the truth showed on the way.
struct SlitRecord {
  double seconds = 0.0;
  double slit_clearance_m = 1e3;    // least, any link to panel or wall
  double sphere_clearance_m = 1e3;  // least, any link to the obstacle
  double x5_deg = 0.0;              // largest |X5| while the tip is in the slit
  double x4_deg = 0.0;              // largest |X4| since it was brought to 0
  double least_N = 1e9;             // tension anywhere
  double min_motor_N = 1e9;
  double max_motor_N = 0.0;
  double contact_N = 0.0;
  double estimate_deg = 0.0;  // largest error of measured theta, at the ends of the legs
  double tip_goal_mm = 0.0;   // end: true tip against the last goal, nothing but the core's open loop
  double tip_goal_deg = 0.0;
  double tip_command_mm = 0.0;  // end: true tip against the kinematics of the commanded angles
  std::int32_t faults = 0;
};

// Boots and takes the arm along all legs; every plant is run once per process.
const SlitRecord& cross_slit(const std::string& physics, std::uint64_t seed);

}  // namespace liana::closed_loop
