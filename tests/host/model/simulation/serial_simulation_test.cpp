// Where the links of a serial arm go: by the core's kinematics, by hand, and between two rows.
#include "host/model/simulation/serial_simulation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/firmware_like/micro_arm.hpp"

namespace liana::simulation {
namespace {

using serial::JointVector;
using Rows = ToldRows<JointVector>;

constexpr double kRadius_m = 0.15;

SerialModel micro_model() { return {serial::micro::table(), kRadius_m, {}, {}, ""}; }

JointVector joints_deg(const serial::micro::Degrees& joint_deg) { return serial::micro::radians(joint_deg); }

config::SceneConfig scene_with_ball(const Vec3& center_m, double radius_m) {
  config::SceneConfig scene;
  scene.spheres.push_back({"ball", center_m, radius_m});
  return scene;
}

// The arm standing at one pose.
Distances standing(const SerialModel& model, const config::SceneConfig& scene, const JointVector& joint_rad) {
  return SerialSimulation(model, scene).run(joint_rad, {0.02, {joint_rad, joint_rad}}).distances;
}

// req:C8
TEST(SerialAxis, EndsWhereTheCoresOwnKinematicsHasJointsAndTip) {
  serial::micro::Random random(31);
  for (const serial::RobotParams& table : {serial::micro::table(), serial::micro::six_joint_table()}) {
    for (int i = 0; i < 200; ++i) {
      const JointVector joint_rad = serial::micro::random_joints(table, random);
      const SerialAxis axis = serial_axis(table, joint_rad);
      const serial::ArmKinematics core = serial::forward_kinematics(table, joint_rad);
      ASSERT_EQ(axis.count, 2 * table.joints() + 1);
      for (std::size_t joint = 0; joint <= table.joints(); ++joint)
        ASSERT_LT(norm(subtract(axis.point_m[2 * joint], core.point_in_base[joint])), 1e-12);
      ASSERT_LT(norm(subtract(axis.tip_m(), core.tip_in_base.position_m)), 1e-12);
    }
  }
}

TEST(SerialAxis, IsAsLongAsAllPiecesTogether) {
  EXPECT_NEAR(axis_length_m(serial::micro::table()), 2 * 2.10 + 2 * 0.28 + 2 * 0.22 + 2 * 0.20, 1e-12);
}

TEST(SerialSimulation, JointsFollowARampByTheDrivesLagAndStayAsFarBesideItAsTheyWere) {
  const SerialModel model = micro_model();
  Rows told{0.02, {}};
  JointVector at = joints_deg(serial::micro::kBent_deg);
  const double rate_rad_s = 0.05, beside_rad = 0.003;
  for (int row = 0; row < 50; ++row) {
    told.rows_rad.push_back(at);
    at[3] += rate_rad_s * 0.02;
  }
  JointVector start = told.rows_rad.front();
  start[3] += beside_rad - rate_rad_s * model.table.servo_time_constant_s;
  SerialSimulation simulation(model, {});
  const SerialMotion& motion = simulation.run(start, told);
  const double expected_rad = told.rows_rad.back()[3] + beside_rad - rate_rad_s * model.table.servo_time_constant_s;
  EXPECT_NEAR(motion.joint_rad.back()[3], expected_rad, 1e-12);
  EXPECT_EQ(motion.joint_rad.back()[2], start[2]);
}

TEST(SerialSimulation, OnceTheDrivesAreToldToStandTheJointsComeUp) {
  Rows told{0.02, std::vector<JointVector>(40, joints_deg(serial::micro::kBent_deg))};
  told.rows_rad.front()[0] -= 0.01;
  SerialSimulation simulation(micro_model(), {});
  JointVector start = told.rows_rad.front();
  start[0] -= 0.01 / 0.02 * 0.03;  // as far behind as drives that have followed so fast for long
  const SerialMotion& motion = simulation.run(start, told);
  EXPECT_NEAR(motion.joint_rad.back()[0], told.rows_rad.back()[0], 1e-9);
}

// The stretched arm lies in a plane; its tip is known by hand.
TEST(SerialSimulation, ABallBesideTheTipIsAsFarAsByHand) {
  const JointVector stretched = joints_deg({});
  const Vec3 tip_m = serial_axis(serial::micro::table(), stretched).tip_m();
  const Distances near = standing(micro_model(), scene_with_ball(add(tip_m, {0.5, 0.0, 0.0}), 0.1), stretched);
  EXPECT_NEAR(near.scene.distance_m, 0.5 - 0.1 - kRadius_m, 1e-9);
  EXPECT_EQ(near.scene.link, 6) << "links are numbered as joints, not as pieces";
  EXPECT_EQ(near.scene_at_start_m, near.scene_at_end_m);
}

TEST(SerialSimulation, TheFloorThatTheArmIsBoltedToIsNoBodyForWhatNeverMoves) {
  config::SceneConfig scene;
  scene.boxes.push_back({"floor", {0.0, 0.0, -0.5}, {5.0, 5.0, 0.5}, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}});
  const Distances up = standing(micro_model(), scene, joints_deg({0, 60, -30, 100, -40, 60, 0}));
  EXPECT_NEAR(up.scene.distance_m, 0.03, 1e-9) << "link 3 begins 0.18 m above it";
  EXPECT_EQ(up.scene.link, 2);
  const Distances down = standing(micro_model(), scene, joints_deg({0, -60, -30, 100, -40, 60, 0}));
  EXPECT_LT(down.scene.distance_m, 0.0);
}

// The stretched arm, whose tip is inside a ball, and a second ball farther off.
TEST(SerialSimulation, BesideABodyThatTheArmTouchesEveryOtherIsMeasuredByItself) {
  const JointVector stretched = joints_deg({});
  const Vec3 tip_m = serial_axis(serial::micro::table(), stretched).tip_m();
  config::SceneConfig scene = scene_with_ball(tip_m, 0.1);
  EXPECT_EQ(standing(micro_model(), scene_with_ball(add(tip_m, {0.5, 0.0, 0.0}), 0.1), stretched).bodies.size(), 0u);
  scene.spheres.push_back({"second", add(tip_m, {0.5, 0.0, 0.0}), 0.1});
  const Distances near = standing(micro_model(), scene, stretched);
  ASSERT_EQ(near.bodies.size(), 2u);
  EXPECT_LT(near.bodies[0].at_start_m, -0.1);
  EXPECT_NEAR(near.bodies[1].at_start_m, 0.5 - 0.1 - kRadius_m, 1e-9);
  EXPECT_NEAR(near.bodies[1].nearest.distance_m, 0.5 - 0.1 - kRadius_m, 1e-9);
  EXPECT_EQ(near.bodies[1].nearest.other, 1);
  EXPECT_EQ(near.bodies[1].nearest.link, 6);
}

TEST(SerialSimulation, ABallThatIsOnlyNearInTheMiddleOfAMotionIsSeen) {
  const SerialModel model = micro_model();
  JointVector at = joints_deg(serial::micro::kBent_deg), middle = at;
  middle[0] += 0.02;
  const Vec3 there_m = serial_axis(model.table, middle).tip_m();
  Rows told{0.02, {}};
  for (int row = 0; row <= 40; ++row, at[0] += 0.001) told.rows_rad.push_back(at);
  SerialSimulation simulation(model, scene_with_ball(there_m, 0.001));
  const Distances& near = simulation.run(told.rows_rad.front(), told).distances;
  EXPECT_LT(near.scene.distance_m, 0.0);
  EXPECT_NEAR(near.scene.time_s, 0.4, 0.2);
}

TEST(SerialSimulation, APlateThinnerThanTheWayFromRowToRowIsSeen) {
  const SerialModel model = {serial::micro::table(), 0.001, {}, {}, ""};
  const JointVector from = joints_deg(serial::micro::kBent_deg);
  JointVector to = from, middle = from;
  to[0] += 0.2;
  middle[0] += 0.1;
  const Vec3 there_m = serial_axis(model.table, middle).tip_m();
  SerialSimulation simulation(model, scene_with_ball(there_m, 0.0005));
  const Distances near = simulation.run(from, {0.02, {from, to, to}}).distances;
  EXPECT_GT(near.scene_at_start_m, 0.1);
  EXPECT_LE(near.scene.distance_m, 0.0) << "no row is within 0.1 m of it";
}

// A payload of 1 m and 0.3 m about the tip's z: as a body has it from the side, and from ahead.
TEST(SerialSimulation, WhatTheArmCarriesIsPartOfIt) {
  const JointVector bent = joints_deg(serial::micro::kBent_deg);
  const SerialAxis axis = serial_axis(serial::micro::table(), bent);
  const Vec3 across = cross(axis.tip_axis[2], {1.0, 0.0, 0.0}), aside = scale(across, 1.0 / norm(across));
  struct Case {
    double along_m, aside_m, off_m;
  };
  for (const Case& here : {Case{0.5, 1.0, 0.6}, Case{0.3, 0.6, 0.2}, Case{1.5, 0.0, 0.4}}) {
    config::SceneConfig scene = scene_with_ball(add(axis.beyond_tip_m(here.along_m), scale(aside, here.aside_m)), 0.1);
    scene.payload.emplace();
    scene.payload->length_m = 1.0;
    scene.payload->radius_m = 0.3;
    SerialSimulation simulation(micro_model(), scene);
    const Rows told{0.02, {bent, bent}};
    const double without_m = simulation.run(bent, told).distances.scene.distance_m;
    const Nearest with = simulation.run(bent, told, true).distances.scene;
    EXPECT_NEAR(with.distance_m, here.off_m, 1e-9) << here.along_m;
    EXPECT_LT(with.distance_m, without_m);
    EXPECT_EQ(simulation.contact().link_name(with.link), "the payload");
    EXPECT_EQ(simulation.run(bent, told).distances.scene.distance_m, without_m) << "it is let go again";
  }
}

// A disc of 1 m and a length of 0.1 m is a ball about its middle.
TEST(SerialSimulation, APayloadThickerThanLongIsABall) {
  config::ScenePayload disc;
  disc.length_m = 0.1;
  disc.radius_m = 1.0;
  const CarriedBody body = carried_body(disc);
  EXPECT_EQ(body.from_m, 0.05);
  EXPECT_EQ(body.to_m, 0.05);
  EXPECT_EQ(body.radius_m, 1.0);
}

// With nothing on the tip both booms at a right angle are far from one another; a payload of 3 m is in the first one.
TEST(SerialContact, WhatTheArmCarriesTouchesLinksAndTheArmBelow) {
  SerialModel model = micro_model();
  config::SceneConfig scene;
  scene.payload.emplace();
  scene.payload->length_m = 3.0;
  scene.payload->radius_m = 0.2;
  serial::micro::Random random(23);
  SerialSimulation simulation(model, scene);
  int touched = 0;
  for (int i = 0; i < 300; ++i) {
    const JointVector joint_rad = serial::micro::random_joints(model.table, random);
    const Rows told{0.02, {joint_rad, joint_rad}};
    if (simulation.run(joint_rad, told).distances.self.distance_m <= 0.0) continue;
    const Nearest near = simulation.run(joint_rad, told, true).distances.self;
    if (near.distance_m > 0.0) continue;
    ++touched;
    EXPECT_EQ(simulation.contact().link_name(near.link), "the payload");
    // By hand: the least distance of points of both axes.
    const SerialAxis axis = serial_axis(model.table, joint_rad);
    double by_hand_m = clearance::kNoObstacle_m;
    for (std::size_t piece = 0; piece + 1 < axis.count; ++piece) {
      if (static_cast<std::int32_t>(piece) / kPiecesPerLink != near.other) continue;
      for (int k = 0; k <= 100; ++k)
        for (int n = 0; n <= 300; ++n) {
          const Vec3 way = subtract(axis.point_m[piece + 1], axis.point_m[piece]);
          const Vec3 there = axis.beyond_tip_m(0.2 + 2.6 * n / 300.0);
          by_hand_m = std::min(by_hand_m, norm(subtract(add(axis.point_m[piece], scale(way, k / 100.0)), there)));
        }
    }
    EXPECT_NEAR(near.distance_m, by_hand_m - 0.2 - kRadius_m, 0.02);
  }
  EXPECT_GT(touched, 5);
}

TEST(SerialContact, AnArmThatFoldsItsBoomsAndWristBackTouchesItsFirstLink) {
  const SerialModel model = micro_model();
  EXPECT_GT(standing(model, {}, joints_deg(serial::micro::kBent_deg)).self.distance_m, 0.0);
  // Both booms of 2.1 m folded one on the other: the wrist is back at the base.
  const Distances folded = standing(model, {}, joints_deg({0, 0, 0, 180, 0, 0, 0}));
  EXPECT_LT(folded.self.distance_m, 0.0);
}

// Folded by 150 deg the booms are in one another beside the elbow, the wrist is 1.1 m off the base.
TEST(SerialContact, WhatIsNearAlongTheArmIsLeftToTheRangesOfTheJoints) {
  EXPECT_GT(standing(micro_model(), {}, joints_deg({0, 0, 0, 150, 0, 0, 0})).self.distance_m, 0.0);
}

// What this arm stands on is in its way as well: a column behind its base, which stands still.
TEST(SerialContact, TheArmBelowIsPartOfWhatCanBeTouched) {
  SerialModel model = micro_model();
  model.base = {{{0.0, 0.0, -4.0}, {0.0, 0.0, 0.0}, 0.2}};
  model.base_of_link = {3};
  model.base_name = "macro";
  serial::micro::Random random(17);
  double least_m = clearance::kNoObstacle_m;
  SerialSimulation simulation(model, {});
  for (int i = 0; i < 500; ++i) {
    const JointVector joint_rad = serial::micro::random_joints(model.table, random);
    const Distances near = simulation.run(joint_rad, {0.02, {joint_rad, joint_rad}}).distances;
    if (near.self.other != 11 || near.self.distance_m > std::min(least_m, 0.9 * kEnoughSelf_m)) continue;
    least_m = near.self.distance_m;
    // By hand: the nearest of all points of the link's two pieces to the column's axis.
    const SerialAxis axis = serial_axis(model.table, joint_rad);
    double by_hand_m = clearance::kNoObstacle_m;
    const auto link = static_cast<std::size_t>(near.self.link);
    ASSERT_GE(link, 2u) << "the first two links are beside what they stand on at any pose";
    for (std::size_t piece = link == 2 ? 5 : 2 * link; piece <= 2 * link + 1; ++piece) {
      for (int k = 0; k <= 1000; ++k) {
        const Vec3 way = subtract(axis.point_m[piece + 1], axis.point_m[piece]);
        const Vec3 p = add(axis.point_m[piece], scale(way, k / 1000.0));
        const double beyond_m = std::max({0.0, p[2], -4.0 - p[2]});
        by_hand_m = std::min(by_hand_m, std::hypot(p[0], p[1], beyond_m) - 0.2 - kRadius_m);
      }
    }
    EXPECT_NEAR(near.self.distance_m, by_hand_m, 2e-3);
  }
  EXPECT_LT(least_m, 0.0) << "some of the poses have to be ones that touch it";
  EXPECT_EQ(simulation.contact().link_name(11), "link 4 of macro");
  EXPECT_EQ(simulation.contact().link_name(2), "link 3");
}

// req:B6
TEST(SerialModel, AnArmBelowThatCarriesIsLookedAtOnItsWholeWay) {
  config::SerialRobotConfig robot;
  robot.table = serial::micro::table();
  robot.link_radius_m = kRadius_m;
  robot.base.emplace();
  robot.base->name = "macro";
  robot.base->table = serial::micro::table();
  robot.base->link_radius_m = 0.2;
  robot.base->joint_rad = joints_deg({0, 60, -30, 100, -40, 60, 0});
  robot.base->named_poses_rad["fetch"] = joints_deg({0, -60, 30, 100, 40, -60, 0});
  config::SceneConfig scene;
  EXPECT_EQ(serial_model(robot, scene).base.size(), 14u) << "locked for good";
  scene.payload.emplace();
  scene.payload->fetch_pose = "fetch";
  EXPECT_THROW(serial_model(robot, scene), std::runtime_error) << "how long that takes is not said";
  robot.base->carry_s = 100.0;
  const SerialModel model = serial_model(robot, scene);
  EXPECT_EQ(model.base.size(), 5 * 14u);
  EXPECT_EQ(model.base_of_link.size(), 14u);
  // Its last piece ends at this arm's base wherever it is; the first one begins at the root, elsewhere each time.
  for (std::size_t place = 0; place < 5; ++place) EXPECT_LT(norm(model.base[14 * place + 13].to_m), 1e-9);
  EXPECT_GT(norm(subtract(model.base[0].from_m, model.base[14].from_m)), 1.0);
  const SerialContact both(model), locked(serial_model(robot));
  serial::micro::Random random(5);
  int nearer = 0;
  for (int i = 0; i < 200; ++i) {
    const SerialAxis axis = serial_axis(model.table, serial::micro::random_joints(model.table, random));
    const double least_m = both.least(axis).nearest_m;
    EXPECT_LE(least_m, locked.least(axis).nearest_m);
    if (least_m < locked.least(axis).nearest_m - 0.01) ++nearer;
  }
  EXPECT_GT(nearer, 10);
  scene.payload->fetch_pose = "nowhere";
  EXPECT_THROW(serial_model(robot, scene), std::runtime_error);
}

}  // namespace
}  // namespace liana::simulation
