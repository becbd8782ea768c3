// Joint angles for the end of a plan whose goal is a tip pose.
#include "host/planning/planner/start/goal_poses.hpp"

#include <gtest/gtest.h>

#include "tests/host/planning/planner/requests.hpp"

namespace liana::planner {
namespace {

// The tip of `to` among four large spheres that stand 6 mm beside that pose, and in the way of all others that pushing
// comes to.
PlanRequest request_among_spheres() {
  config::SceneConfig scene;
  scene.spheres = {{"a", {0.577, 1.641, 1.795}, 0.160},
                   {"b", {0.601, 0.712, 0.567}, 0.193},
                   {"c", {0.504, 1.206, 1.399}, 0.288},
                   {"d", {0.590, 1.613, 2.262}, 0.249}};
  PlanRequest request = request_between({-6.51, 3.87, 3.06, 6.43, 7.01, 2.18, 0.55, -7.17, -6.48, 2.27},
                                        {8.12, -9.81, -4.03, 0.14, 0.90, 4.86, 3.15, -2.99, 5.16, 2.16}, scene);
  request.tip_in_base = forward_kinematics(request.robot.table, *request.to_rad).tip_in_base;
  request.to_rad.reset();
  return request;
}

TEST(GoalPoses, AreFoundAmongSpheresWherePushingGetsStuck) {
  const PlanRequest request = request_among_spheres();
  const Room room(request.robot, request.scene);
  const GoalPoses poses = goal_poses(room, request);
  ASSERT_FALSE(poses.theta_rad.empty());
  EXPECT_GE(room.look(poses.theta_rad.front()).nearest.distance_m, request.margin_m);
}

TEST(GoalPoses, SayWhichPoseComesNearestWhenNoneIsFree) {
  PlanRequest request = request_among_spheres();
  request.scene.spheres.push_back({"tip", request.tip_in_base->position_m, 0.02});
  const GoalPoses poses = goal_poses(Room(request.robot, request.scene), request);
  EXPECT_TRUE(poses.theta_rad.empty());
  EXPECT_TRUE(poses.reachable);
  EXPECT_LT(Room(request.robot, request.scene).look(poses.nearest_rad).nearest.distance_m, 0.0);
}

}  // namespace
}  // namespace liana::planner
