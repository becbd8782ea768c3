#include "slit_path.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "firmware_like/cable/motion/servo_ik.hpp"
#include "firmware_like/math/trig.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

constexpr std::size_t kX4 = 6, kX5 = 8;  // pitch of segments 4 and 5
constexpr std::uint32_t kHoldX5 = 1u << kX5;
constexpr std::uint32_t kHoldX4X5 = kHoldX5 | 1u << kX4;

// In the slit plane, `u_m` along the arm's way and `w_m` across it, in the attitude of the rod.
Pose in_slit(double u_m, double w_m) {
  const config::SceneSlit& slit = *scene().slit;
  const Vec3 position = add(add(scale(slit.u_axis, u_m), scale(slit.w_axis, w_m)), scale(slit.normal, slit.offset_m));
  return {position, scene().rod->pose.quaternion_wxyz};
}

Pose rod() { return {scene().rod->pose.position_m, scene().rod->pose.quaternion_wxyz}; }

void look(ArmUnderControl& arm, std::uint32_t at_zero, SlitRecord& record) {
  Plant& plant = arm.plant();
  record.seconds += arm.table().tick_s;
  if (arm.outputs().tick % static_cast<std::uint64_t>(arm.table().interval_ticks) == 0) {
    record.slit_clearance_m = std::min(record.slit_clearance_m, plant.slit_clearance_m());
    record.sphere_clearance_m = std::min(record.sphere_clearance_m, plant.sphere_clearance_m());
  }
  const double tip_u_m = dot(scene().slit->u_axis, plant.tip_in_base().position_m);
  if ((at_zero & kHoldX5) != 0 && tip_u_m > scene().slit->mouth_u_m)
    record.x5_deg = std::max(record.x5_deg, std::fabs(plant.theta_rad()[kX5]) / kDegree);
  if ((at_zero & 1u << kX4) != 0) record.x4_deg = std::max(record.x4_deg, std::fabs(plant.theta_rad()[kX4]) / kDegree);
}

void finish(ArmUnderControl& arm, const Pose& goal, SlitRecord& record) {
  const Load load = arm.plant().take_load();
  record.least_N = load.least_N;
  record.min_motor_N = load.min_motor_N;
  record.max_motor_N = load.max_motor_N;
  record.contact_N = load.contact_N;
  const std::array<double, 6> error = pose_error(goal, arm.plant().tip_in_base());
  record.tip_goal_mm = 1000.0 * norm({error[0], error[1], error[2]});
  record.tip_goal_deg = norm({error[3], error[4], error[5]}) / kDegree;
  record.tip_command_mm = arm.error_against_command().tip_mm;
  record.faults = arm.outputs().faults.count;
}

SlitRecord run(const std::string& physics, std::uint64_t seed) {
  ArmUnderControl arm({physics, seed, true, "prepare"});
  arm.boot();
  arm.plant().take_load();  // enabling tightens the cables from what they were found with
  SlitRecord record;
  Pose from = arm.outputs().tip_command;
  const Vec3 node_from_m = arm.outputs().node_command_m[2];
  std::uint32_t at_zero = 0;  // held thetas that a whole leg has brought to 0
  for (const Leg& leg : slit_legs()) {
    arm.follow(
        leg.seconds, [&](double share) { return leg_setpoint(leg, from, node_from_m, share); },
        [&](ArmUnderControl& now) { look(now, at_zero, record); });
    const cable::Outputs& out = arm.outputs();
    record.estimate_deg =
        std::max(record.estimate_deg, largest_difference_deg(out.theta_measured_rad, arm.plant().theta_rad()));
    if (out.held_at_target != 0) at_zero = leg.held_mask;
    from = leg.goal_in_base;
  }
  finish(arm, from, record);
  return record;
}

}  // namespace

std::vector<Leg> slit_legs() {
  const double free_m_s = robot_table().limits.tip_speed_m_s;
  const double slit_m_s = robot_table().limits.tip_speed_slit_m_s;
  const Pose edge = tip_at("panel_edge");
  return {{"to the panel edge", edge, 34.0, 0, free_m_s, true},
          {"segment 5 planar", edge, 6.0, kHoldX5, free_m_s, false},
          {"before the mouth", in_slit(1.35, 0.500), 22.0, kHoldX5, free_m_s, false},
          {"to the mouth", in_slit(1.65, 0.476), 7.0, kHoldX5, free_m_s, false},
          {"segment 5 into the slit", in_slit(3.10, 0.360), 60.0, kHoldX5, slit_m_s, false},
          {"segment 4 planar", in_slit(3.10, 0.360), 8.0, kHoldX4X5, slit_m_s, false},
          {"to the rod", rod(), 16.0, kHoldX4X5, slit_m_s, false},
          {"at the rod", rod(), 5.0, kHoldX4X5, slit_m_s, false}};
}

Vec3 node_3_at_panel_edge_m() {
  return forward_kinematics(robot_table(), named_pose_rad("panel_edge")).node_in_base[3].position_m;
}

cable::Setpoint leg_setpoint(const Leg& leg, const Pose& from, const Vec3& node_from_m, double share) {
  const double done = minimum_jerk(share);
  const Vec3 turn = rotation_vector(multiply(leg.goal_in_base.quaternion, conjugate(from.quaternion)));
  cable::Setpoint setpoint;
  setpoint.kind = CommandKind::kTip;
  setpoint.tip_in_base.position_m =
      add(from.position_m, scale(subtract(leg.goal_in_base.position_m, from.position_m), done));
  setpoint.tip_in_base.quaternion = normalize(multiply(quaternion_of(scale(turn, done)), from.quaternion));
  setpoint.held_mask = leg.held_mask;
  setpoint.tip_speed_m_s = leg.speed_m_s;
  if (leg.steers_shape) {
    setpoint.node[0] = {3, add(node_from_m, scale(subtract(node_3_at_panel_edge_m(), node_from_m), done)), 1.0, 0.005};
  }
  return setpoint;
}

const SlitRecord& cross_slit(const std::string& physics, std::uint64_t seed) {
  static std::map<std::pair<std::string, std::uint64_t>, SlitRecord> records;
  const auto key = std::make_pair(physics, seed);
  const auto found = records.find(key);
  return found != records.end() ? found->second : records.emplace(key, run(physics, seed)).first->second;
}

}  // namespace liana::closed_loop
