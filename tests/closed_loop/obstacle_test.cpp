// Why the shape is steered: the tip alone leads the arm's middle into the sphere (mission, A8). Kinematics
// only.
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware_like/cable/motion/motion.hpp"
#include "firmware_like/cable/motion/servo_ik.hpp"
#include "fixture.hpp"
#include "slit_path.hpp"

namespace liana::closed_loop {
namespace {

double segment_point_distance_m(const Vec3& a, const Vec3& b, const Vec3& point) {
  const Vec3 along = subtract(b, a);
  const double share = std::clamp(dot(subtract(point, a), along) / dot(along, along), 0.0, 1.0);
  return norm(subtract(point, add(a, scale(along, share))));
}

// Least distance of any link's axis to the centre of the obstacle.
double distance_to_centre_m(const cable::ThetaVector& theta_rad) {
  const cable::LinkPoints links = link_points(robot_table(), theta_rad);
  double least_m = 1e3;
  for (std::size_t i = 1; i < static_cast<std::size_t>(links.count); ++i) {
    const double distance_m =
        segment_point_distance_m(links.point_in_base[i - 1], links.point_in_base[i], scene().spheres[0].center_m);
    least_m = std::min(least_m, distance_m);
  }
  return least_m;
}

// Sphere and arm are this thick together.
double thickness_m() { return scene().spheres[0].radius_m + 0.030; }

Leg first_leg(bool steers_shape) {
  Leg leg = slit_legs().front();
  leg.steers_shape = steers_shape;
  return leg;
}

TEST(Obstacle, TheTipAloneOnAStraightWayLeadsTheArmThroughTheSphere) {
  const Leg leg = first_leg(false);
  const Pose from = tip_at("prepare");
  cable::ThetaVector theta = named_pose_rad("prepare");
  double least_m = 1e3;
  double lag_m = 0.0;
  for (int k = 1; k <= 2000; ++k) {
    const cable::IkGoal goal{leg_setpoint(leg, from, {}, k / 2000.0).tip_in_base, 0};
    lag_m = std::max(lag_m,
                     servo_ik(robot_table(), goal, forward_kinematics(robot_table(), theta), theta).position_error_m);
    least_m = std::min(least_m, distance_to_centre_m(theta));
  }
  measured("tip-only motion: least distance of an axis to the sphere's centre", 1000.0 * least_m, "mm");
  EXPECT_LT(lag_m, 0.005) << "the tip must follow, or the motion is another one";
  EXPECT_LT(distance_mm(forward_kinematics(robot_table(), theta).tip_in_base.position_m, leg.goal_in_base.position_m),
            0.1);
  EXPECT_LT(least_m, 0.1 * thickness_m()) << "the arm's middle goes through the sphere's";
}

// req:A42
TEST(Obstacle, SteeringNodeThreeKeepsTheArmTenCentimetresOffTheSphere) {
  const cable::RobotParams& table = robot_table();
  const Leg leg = first_leg(true);
  const Pose from = tip_at("prepare");
  const cable::CableLayout layout = cable_layout(table);
  cable::MotionState motion;
  reset_motion(table, named_pose_rad("prepare"), motion);
  const Vec3 node_from_m = forward_kinematics(table, named_pose_rad("prepare")).node_in_base[3].position_m;
  double least_m = 1e3;
  const int intervals = static_cast<int>(leg.seconds / (table.tick_s * table.interval_ticks));
  for (int tick = 0; tick < (intervals + 50) * table.interval_ticks; ++tick) {
    const double share = std::min(1.0, (tick / table.interval_ticks + 1.0) / intervals);
    if (tick % table.interval_ticks == 0) accept_setpoint(table, leg_setpoint(leg, from, node_from_m, share), motion);
    advance_motion(table, cable_geometry(table, layout, arm_trig(table, motion.limiter.theta_rad)), true, motion);
    least_m = std::min(least_m, distance_to_centre_m(motion.limiter.theta_rad));
  }
  const Pose tip = forward_kinematics(table, motion.limiter.theta_rad).tip_in_base;
  measured("steered motion: least clearance to the sphere", 1000.0 * (least_m - thickness_m()), "mm");
  EXPECT_GT(least_m - thickness_m(), 0.100);
  EXPECT_LT(distance_mm(tip.position_m, leg.goal_in_base.position_m), 1.0) << "the tip must have gone the same way";
}

}  // namespace
}  // namespace liana::closed_loop
