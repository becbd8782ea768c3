// An arm on a base that feeds: where slide and roll put it, what they carry, what their drives count, what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench_harness.hpp"
#include "hil/arm/arm_physics.hpp"
#include "hil/arm/kinematic_arm.hpp"
#include "hil/bench/drive_bank.hpp"
#include "hil/drive/servo_motor.hpp"
#include "tests/message.hpp"

namespace liana::bench {
namespace {

constexpr double kG = 9.80665;
constexpr std::size_t kCables = 12;

RobotConfig feeder() { return load_robot(HIL_DATA "/feeder.json"); }

// The same arm fixed to the base frame.
RobotConfig fixed(RobotConfig robot) {
  robot.base.reset();
  robot.segments.erase(robot.segments.begin());
  robot.drives.erase(robot.drives.begin(), robot.drives.begin() + kBaseDrives);
  return robot;
}

Theta fixed(const Theta& theta) {
  Theta bends{};
  std::copy(theta.begin() + kBaseDrives, theta.end(), bends.begin());
  return bends;
}

SceneConfig open_space() {
  SceneConfig scene = fixture_scene();
  scene.boxes.clear();
  scene.spheres.clear();
  return scene;
}

Theta pose_of(const std::vector<double>& deg) {
  Theta theta{};
  for (std::size_t i = 0; i < deg.size(); ++i) theta[i] = kRadPerDeg * deg[i];
  return theta;
}

Theta look() { return pose_of({-20, 30, 6, -4, 5, 5, -6, 4, 3, 6}); }

TrueParameters with_gravity(const RobotConfig& robot, const Vec3& gravity_m_s2) {
  TrueParameters truth = table_parameters(robot, "ideal");
  truth.gravity_m_s2 = gravity_m_s2;
  return truth;
}

ArmPhysics feeder_arm(const RobotConfig& robot, const Vec3& gravity_m_s2, const Theta& theta) {
  return ArmPhysics(robot, open_space(), with_gravity(robot, gravity_m_s2), theta);
}

void rest(ArmPhysics& arm, const CableValues& payout_m, double seconds) {
  arm.begin_slot(kSlot_s);
  const double step_s = arm.longest_step_s();
  for (double left_s = seconds; left_s > 1e-9; left_s -= step_s) arm.step(step_s, payout_m);
}

// Links, carriage and what gravity does to each: force and moment about x of the base frame.
struct Weight {
  double along_x_N = 0.0;
  double about_x_Nm = 0.0;
};

Weight weight_of(const RobotConfig& robot, Chain& chain, const Vec3& gravity_m_s2) {
  Weight weight{robot.base->mass_kg * gravity_m_s2.x, 0.0};
  const double link_kg = robot.segments.back().module_mass_kg;
  for (std::size_t i = 0; i < chain.link_count(); ++i) {
    const Vec3 middle_m = 0.5 * (chain.joint_center_m(i) + chain.joint_center_m(i + 1));
    weight.along_x_N += link_kg * gravity_m_s2.x;
    weight.about_x_Nm += cross(middle_m, link_kg * gravity_m_s2).x;
  }
  return weight;
}

TEST(Base, IsReadAsASegmentWithoutModulesAndTwoDrives) {
  const RobotConfig robot = feeder();
  ASSERT_TRUE(robot.base);
  EXPECT_EQ(robot.segments.size(), 5U);
  EXPECT_EQ(robot.theta_count(), 10U);
  EXPECT_EQ(robot.link_count(), 16U);
  EXPECT_EQ(robot.drive_count(), 14U);
  EXPECT_NEAR(robot.segments[0].theta_limit_rad, 90 * kRadPerDeg, 1e-12);
  const std::vector<double> paths_m = robot.paths_at_zero_m(), without_m = fixed(robot).paths_at_zero_m();
  ASSERT_EQ(paths_m.size(), 14U);
  EXPECT_NEAR(paths_m[0], 0.45, 1e-12);
  EXPECT_NEAR(paths_m[1], 0.05 * 90 * kRadPerDeg, 1e-12);
  for (std::size_t c = 0; c < kCables; ++c) EXPECT_EQ(paths_m[kBaseDrives + c], without_m[c]);
}

TEST(Base, IsRefusedWithFieldAndWhatIsAllowed) {
  const auto refusal = [](const char* patch) {
    nlohmann::json table = nlohmann::json::parse(content(HIL_DATA "/feeder.json"));
    table.merge_patch(nlohmann::json::parse(patch));
    const std::string path = temporary("base.json");
    std::ofstream(path) << table;
    try {
      load_robot(path);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("{}"), "");
  EXPECT_TRUE(names(refusal(R"({"base":{"mass_kg":0}})"), {"/base/mass_kg", "0", "0.001", "1000"}));
  EXPECT_TRUE(names(refusal(R"({"base":{"roll_radius_m":null}})"), {"/base/roll_radius_m", "missing"}));
  EXPECT_TRUE(names(refusal(R"({"named_poses_deg":{"far":[91,0,0,0,0,0,0,0,0,0]}})"),
                    {"/named_poses_deg/far/0", "91", "-90", "90"}));
  EXPECT_TRUE(names(refusal(R"({"base":{"limit_deg":150},"named_poses_deg":{"far":[0,0,91,0,0,0,0,0,0,0]}})"),
                    {"/named_poses_deg/far/2", "91", "-90", "90"}));
  EXPECT_EQ(refusal(R"({"base":{"limit_deg":150},"named_poses_deg":{"far":[-150,150,0,0,0,0,0,0,0,0]}})"), "");
  EXPECT_TRUE(names(refusal(R"({"drives":{"direction":[1,1,1]}})"), {"/drives/direction", "3", "14"}));
}

// Slide 40 deg of 5 mm, roll a quarter turn, and four joints of 10 deg: an arc in the plane of x and z.
TEST(Base, PutsTheArmWhereAHandWorkedPoseHasIt) {
  const RobotConfig robot = feeder();
  const Theta theta = pose_of({40, 90, 10, 0});
  double along_m = 0.0, up_m = 0.0;
  for (int i = 1; i <= 16; ++i) {
    const double heading = kRadPerDeg * 10.0 * std::min(i, 4);
    along_m += 0.05 * std::cos(heading), up_m += 0.05 * std::sin(heading);
  }
  Chain chain(robot, open_space());
  chain.place(theta);
  EXPECT_LT(norm(chain.joint_center_m(0) - Vec3{0.2, 0.0, 0.0}), 1e-12);
  for (const Pose& tip : {chain.tip(), tip_of(robot, theta)}) {
    EXPECT_LT(norm(tip.position_m - Vec3{0.2 + along_m, 0.0, up_m}), 1e-12);
    const double c = std::cos(40 * kRadPerDeg), s = std::sin(40 * kRadPerDeg);
    EXPECT_LT(norm(rotate(tip.attitude, {1, 0, 0}) - Vec3{c, 0, s}), 1e-12);
    EXPECT_LT(norm(rotate(tip.attitude, {0, 1, 0}) - Vec3{-s, 0, c}), 1e-12);
    EXPECT_LT(norm(rotate(tip.attitude, {0, 0, 1}) - Vec3{0, -1, 0}), 1e-12);
  }
}

TEST(Base, MovesTheWholeArmAsOneBodyAndNoCable) {
  const RobotConfig robot = feeder(), alone = fixed(robot);
  SceneConfig scene = open_space();
  scene.spheres.push_back({"ball", {0.5, 0.3, 0.1}, 0.05});
  Chain chain(robot, scene, true), arm(alone, scene);
  chain.set_linkage(uneven_linkage(robot, 0.1, 3));
  arm.set_linkage(uneven_linkage(alone, 0.1, 3));
  CablePaths paths(robot, 0.0, uneven_linkage(robot, 0.1, 3)), without(alone, 0.0, uneven_linkage(alone, 0.1, 3));
  Random random(4, "base poses");
  for (int i = 0; i < 50; ++i) {
    Theta theta = random_theta(random, 18.0);
    theta[0] *= 5.0, theta[1] *= 5.0;
    chain.place(theta), paths.update(theta);
    arm.place(fixed(theta)), without.update(fixed(theta));
    const Pose carriage{{robot.base->slide_m_per_rad * theta[0], 0, 0}, from_rotation_vector({theta[1], 0, 0})};
    std::vector<Vec3> axis_m;
    for (std::size_t k = 0; k <= 16; ++k) {
      axis_m.push_back(compose(carriage, {arm.joint_center_m(k), {}}).position_m);
      EXPECT_LT(norm(chain.joint_center_m(k) - axis_m.back()), 1e-12);
    }
    EXPECT_NEAR(clearance_of(chain, scene, 0.03).sphere_m, clearance_of(axis_m, scene, 0.03).sphere_m, 1e-12);
    const std::vector<double> tendons_m = chain.tendon_lengths_m();
    const CableJacobian jacobian = paths.jacobian();
    for (std::size_t c = 0; c < kCables; ++c) {
      EXPECT_EQ(paths.length_m(c), without.length_m(c));
      EXPECT_NEAR(tendons_m[c], paths.length_m(c), 1e-9);
      EXPECT_EQ(jacobian[c][0], 0.0);
      EXPECT_EQ(jacobian[c][1], 0.0);
    }
  }
}

TEST(Base, ItsLinksTouchTheSceneWhereTheyAre) {
  const RobotConfig robot = feeder();
  Chain free_chain(robot, open_space());
  free_chain.place(look());
  const Vec3 from_m = free_chain.joint_center_m(9), to_m = free_chain.joint_center_m(10);
  const Vec3 aside = cross(to_m - from_m, {0.0, 0.0, 1.0});
  const Vec3 out = (1.0 / norm(aside)) * aside;
  SceneConfig scene = open_space();
  scene.spheres.push_back({"ball", 0.5 * (from_m + to_m) + 0.039 * out, 0.01});
  ArmPhysics arm(robot, scene, with_gravity(robot, {}), look());
  EXPECT_NEAR(arm.clearance().sphere_m, -0.001, 1e-6);
  const std::vector<Contact>& contacts = arm.chain().contacts();
  const auto deepest = std::max_element(contacts.begin(), contacts.end(),
                                        [](const Contact& a, const Contact& b) { return a.depth_m < b.depth_m; });
  ASSERT_NE(deepest, contacts.end());
  EXPECT_EQ(deepest->link, 9U);
  EXPECT_NEAR(deepest->depth_m, 0.001, 1e-6);
  EXPECT_LT(norm(deepest->normal + out), 1e-4);
}

TEST(Base, TipAndWeightChangeWithSlideAndRollByTheirDifferences) {
  const RobotConfig robot = feeder();
  Chain chain(robot, open_space());
  const Vec3 gravity{2.0, 1.0, -3.0};
  chain.set_gravity(gravity);
  const auto potential_J = [&](const Theta& theta) {
    chain.place(theta);
    double energy = -robot.base->mass_kg * gravity.x * robot.base->slide_m_per_rad * theta[0];
    for (std::size_t i = 0; i < 16; ++i)
      energy -= 0.04 * dot(gravity, 0.5 * (chain.joint_center_m(i) + chain.joint_center_m(i + 1)));
    return energy;
  };
  Theta theta = look(), weight_Nm;
  chain.place(theta);
  chain.bias(Theta{}, weight_Nm);
  PointJacobian jacobian;
  chain.point_jacobian(15, chain.tip().position_m, jacobian);
  for (std::size_t i = 0; i < 10; ++i) {
    constexpr double kStep = 1e-5;
    Theta ahead = theta, behind = theta;
    ahead[i] += kStep, behind[i] -= kStep;
    const double grown_J = potential_J(ahead) - potential_J(behind);
    chain.place(ahead);
    const Vec3 ahead_m = chain.tip().position_m;
    chain.place(behind);
    const Vec3 moved_m = (0.5 / kStep) * (ahead_m - chain.tip().position_m);
    EXPECT_NEAR(weight_Nm[i], grown_J / (2.0 * kStep), 1e-7) << i;
    EXPECT_LT(norm(moved_m - Vec3{jacobian[0][i], jacobian[1][i], jacobian[2][i]}), 1e-7) << i;
  }
}

TEST(Base, InertiaIsThatOfTheFullModelAndTheSlidesThatOfAllMasses) {
  const RobotConfig robot = feeder();
  Chain chain(robot, open_space());
  chain.place(look());
  ThetaMatrix reduced, expected{};
  chain.inertia(reduced);
  const auto full = chain.full_inertia();
  ASSERT_EQ(full.size(), 34U * 34U);
  for (std::size_t i = 0; i < 34; ++i)
    for (std::size_t j = 0; j < 34; ++j)
      expected[chain.theta_of_hinge(i)][chain.theta_of_hinge(j)] +=
          chain.share_of_hinge(i) * chain.share_of_hinge(j) * full[34 * i + j];
  for (std::size_t a = 0; a < 10; ++a)
    for (std::size_t b = 0; b < 10; ++b) EXPECT_NEAR(reduced[a][b], expected[a][b], 1e-12);
  const double metres = robot.base->slide_m_per_rad;
  EXPECT_NEAR(reduced[0][0], (2.0 + 16 * 0.04) * metres * metres, 1e-9);
}

TEST(Base, InTheMiddleTheArmOnItIsTheArmWithoutIt) {
  const RobotConfig robot = feeder(), alone = fixed(robot);
  Theta theta = look();
  theta[0] = theta[1] = 0.0;
  for (const char* friction : {"ideal", "worn"}) {
    TrueParameters truth = table_parameters(robot, friction);
    truth.gravity_m_s2 = {0.0, 0.0, -kG};
    ArmPhysics on_base(robot, open_space(), truth, theta), without(alone, open_space(), truth, fixed(theta));
    for (std::size_t c = 0; c < kCables; ++c)
      EXPECT_NEAR(on_base.motor_tension_N(kBaseDrives + c), without.motor_tension_N(c), 1e-9) << friction << c;
    CableValues on_base_m = on_base.payouts_m(), without_m = without.payouts_m();
    for (int step = 0; step < 300; ++step) {
      on_base_m[kBaseDrives + 4] -= 1e-6, without_m[4] -= 1e-6;
      on_base.step(kStep_s, on_base_m), without.step(kStep_s, without_m);
    }
    for (std::size_t c = 0; c < kCables; ++c) {
      EXPECT_NEAR(on_base.motor_tension_N(kBaseDrives + c), without.motor_tension_N(c), 0.2) << friction << c;
      EXPECT_NEAR(on_base.least_tension_N(c), without.least_tension_N(c), 0.2);
    }
    const LoadRecord loads = on_base.take_record(), of_alone = without.take_record();
    EXPECT_NEAR(loads.least_tension_N, of_alone.least_tension_N, 0.2) << "slide and roll are no cables";
    EXPECT_NEAR(loads.max_motor_tension_N, of_alone.max_motor_tension_N, 0.2);
  }
}

// Lying with its side down, the arm is the one whose gravity points to that side.
TEST(Base, ARolledArmHasItsWeightTurnedAndItsTensionsFollow) {
  const RobotConfig robot = feeder();
  Theta theta = look();
  theta[1] = 90 * kRadPerDeg;
  const ArmPhysics rolled = feeder_arm(robot, {0.0, 0.0, -kG}, theta);
  // Rx(-90 deg) of what points down.
  const ArmPhysics turned = feeder_arm(fixed(robot), {0.0, -kG, 0.0}, fixed(theta));
  const ArmPhysics upright = feeder_arm(fixed(robot), {0.0, 0.0, -kG}, fixed(theta));
  double apart_N = 0.0;
  for (std::size_t c = 0; c < kCables; ++c) {
    EXPECT_NEAR(rolled.motor_tension_N(kBaseDrives + c), turned.motor_tension_N(c), 1e-9);
    apart_N = std::max(apart_N, std::fabs(turned.motor_tension_N(c) - upright.motor_tension_N(c)));
  }
  EXPECT_GT(apart_N, 5.0);
}

TEST(Base, ItsDrivesCarryTheWeightAndTheArmStaysWhereItStarts) {
  const RobotConfig robot = feeder();
  const Vec3 gravity{0.6 * kG, 0.0, -0.8 * kG};  // the slide slopes down by 37 deg
  ArmPhysics arm = feeder_arm(robot, gravity, look());
  const Weight weight = weight_of(robot, arm.chain(), gravity);
  ASSERT_NEAR(weight.along_x_N, (2.0 + 16 * 0.04) * 0.6 * kG, 1e-12);
  ASSERT_GT(std::fabs(weight.about_x_Nm), 0.1);
  const CableValues payout = arm.payouts_m();
  const Theta start = arm.theta_rad();
  for (int time = 0; time < 2; ++time) {
    EXPECT_NEAR(arm.motor_tension_N(0), weight.along_x_N, 1e-6);
    EXPECT_NEAR(robot.base->roll_radius_m * arm.motor_tension_N(1), weight.about_x_Nm, 1e-6);
    rest(arm, payout, 2.0);
  }
  for (std::size_t i = 0; i < 10; ++i) EXPECT_NEAR(arm.theta_rad()[i], start[i], 1e-8) << i;
  const ArmPhysics uphill = feeder_arm(robot, {-0.6 * kG, 0.0, -0.8 * kG}, look());
  EXPECT_NEAR(uphill.motor_tension_N(0), -weight.along_x_N, 1e-6) << "it pushes as well as it pulls";
}

TEST(Base, FollowsItsDrivesWithoutALag) {
  const RobotConfig robot = feeder();
  for (const double share : {1.0, 0.25}) {
    ArmPhysics arm = feeder_arm(robot, {}, look());
    arm.begin_slot(kSlot_s);
    const double step_s = share * arm.longest_step_s();
    CableValues payout = arm.payouts_m();
    const Theta start = arm.theta_rad();
    const auto steps = static_cast<int>(1.0 / step_s);
    double highest_N = 0.0;
    for (int i = 0; i < steps; ++i) {
      payout[0] += 0.025 * step_s, payout[1] -= 0.005 * step_s;
      arm.step(step_s, payout);
      highest_N = std::max(highest_N, std::fabs(arm.motor_tension_N(0)));
    }
    const double metres = robot.base->slide_m_per_rad;
    EXPECT_NEAR(metres * (arm.theta_rad()[0] - start[0]), 0.025, 1e-5);
    EXPECT_NEAR(0.05 * (arm.theta_rad()[1] - start[1]), -0.005, 1e-5);
    EXPECT_NEAR(metres * arm.rate_rad_s()[0], 0.025, 1e-3);
    EXPECT_LT(highest_N, 200.0) << "as the start's jerk asks";
    EXPECT_LT(std::fabs(arm.motor_tension_N(0)), 2.0) << "an even slide needs no force";
  }
}

TEST(Base, GivesNoEnergyAndItsDampingTakesSome) {
  const RobotConfig robot = feeder();
  ArmPhysics arm = feeder_arm(robot, {}, look());
  arm.set_joint_damping(0.0);
  const CableValues payout = arm.payouts_m();
  const double rest_J = arm.energy_J();
  Theta kick{};
  for (std::size_t i = 0; i < 10; ++i) kick[i] = (i % 3 == 0 ? 5.0 : -2.5) * kRadPerDeg;
  arm.set_state(arm.theta_rad(), kick);
  const double start_J = arm.energy_J() - rest_J;
  double highest_J = 0.0;
  arm.begin_slot(kSlot_s);
  for (int i = 0; i < 4000; ++i) {
    arm.step(arm.longest_step_s(), payout);
    highest_J = std::max(highest_J, arm.energy_J() - rest_J);
  }
  EXPECT_LT(highest_J, 1.02 * start_J);
  EXPECT_LT(arm.energy_J() - rest_J, 0.9 * start_J);
  EXPECT_LT(std::fabs(arm.rate_rad_s()[0]), 0.1 * kRadPerDeg);
}

TEST(Base, CountsAreThoseOfTheConventionAtTheStart) {
  const RobotConfig robot = feeder();
  const ArmPhysics arm = feeder_arm(robot, {}, look());
  const CableValues payout_m = arm.payouts_m();
  const double x_m = -20 * 0.005, belt_m = 0.05 * 30 * kRadPerDeg;
  EXPECT_NEAR(payout_m[0], 0.45 + 0.3 + x_m, 1e-12);
  EXPECT_NEAR(payout_m[1], 0.05 * 90 * kRadPerDeg + 0.3 + belt_m, 1e-12);
  const BusesConfig buses = load_buses(HIL_DATA "/feeder_buses.json");
  const DriveBank bank(robot, buses, with_gravity(robot, {}), payout_m, false, 1);
  ASSERT_EQ(bank.size(), 14U);
  const double per_count_m = 2 * 3.14159265358979323846 * 0.012 / 16384;
  EXPECT_NEAR(bank.drive(0).motor().position_counts(), 500000 - x_m / per_count_m, 1e-6);
  EXPECT_NEAR(bank.drive(1).motor().position_counts(), 501000 + belt_m / per_count_m, 1e-6);
  const ArmPhysics without = feeder_arm(fixed(robot), {}, fixed(look()));
  for (std::size_t c = 0; c < kCables; ++c) {
    EXPECT_EQ(payout_m[kBaseDrives + c], without.payouts_m()[c]);
    EXPECT_NEAR(bank.payouts_m()[kBaseDrives + c], payout_m[kBaseDrives + c], 1e-12);
  }
}

TEST(Base, IsDrawnWithoutErrorsAndItsCablesAsThoseOfTheArmWithoutIt) {
  const RobotConfig robot = feeder(), alone = fixed(robot);
  const TrueParameters truth = spread_parameters(robot, "nominal", 7),
                       of_alone = spread_parameters(alone, "nominal", 7);
  for (std::size_t i = 0; i < kBaseDrives; ++i) EXPECT_EQ(truth.zero_offset_m[i], 0.0);
  for (std::size_t c = 0; c < kCables; ++c) {
    EXPECT_EQ(truth.zero_offset_m[kBaseDrives + c], of_alone.zero_offset_m[c]);
    EXPECT_EQ(truth.torque_gain[kBaseDrives + c], of_alone.torque_gain[c]);
  }
  const RobotConfig built = spread_load(robot, 7), built_alone = spread_load(alone, 7);
  for (std::size_t s = 0; s < 4; ++s)
    EXPECT_EQ(built.segments[s + 1].module_mass_kg, built_alone.segments[s].module_mass_kg);
  EXPECT_EQ(built.base->mass_kg, robot.base->mass_kg);
}

TEST(Base, TheLightArmStandsWhereItsDrivesStand) {
  const RobotConfig robot = feeder();
  KinematicArm arm(robot, with_gravity(robot, {}), look());
  CableValues payout = arm.payouts_m();
  const Theta start = arm.theta_rad();
  payout[0] += 0.1, payout[1] -= 0.02;
  arm.step(kSlot_s, payout);
  EXPECT_NEAR(arm.theta_rad()[0] - start[0], 20 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(arm.theta_rad()[1] - start[1], -0.4, 1e-12);
  for (std::size_t i = kBaseDrives; i < 10; ++i) EXPECT_NEAR(arm.theta_rad()[i], start[i], 1e-9);
  EXPECT_NEAR(arm.tip().position_m.x, tip_of(robot, start).position_m.x + 0.1, 1e-9);
  EXPECT_EQ(arm.motor_tension_N(0), 0.0);
  EXPECT_GT(arm.take_record().least_tension_N, 10.0);
}

TEST(Base, AMotorAtItsTorqueLimitYieldsToALoadOfEitherSign) {
  for (const double side : {1.0, -1.0}) {
    ServoMotor motor(0.03, -1, 0.0, true);
    motor.set_mode(MotorMode::kFollow);
    motor.set_target(-side * 100.0);
    motor.step(0.001, side * 500.0, 400.0);
    EXPECT_EQ(motor.position_counts(), 0.0) << "against the load";
    motor.set_target(side * 100.0);
    motor.step(0.001, side * 500.0, 400.0);
    EXPECT_GT(side * motor.position_counts(), 0.0) << "with it";
  }
}

BenchOptions feeder_options() {
  BenchOptions options = options_of(1);
  options.robot = feeder();
  options.scene = open_space();
  options.buses = load_buses(HIL_DATA "/feeder_buses.json");
  options.start_pose = "look";
  options.spread = false;
  return options;
}

struct FeederRun {
  Truth truth;
  std::array<int, 15> torque_permille{};
};

// All drives are enabled from slot 49 on; from slot 90 on all targets move by `counts_per_slot`.
FeederRun run_feeder(BenchOptions options, std::uint32_t slots, int counts_per_slot) {
  options.truth_path = temporary("base_truth.bin");
  ScriptedBus bus(slots, counts_per_slot, 14, 7);
  {
    Bench bench(options);
    bench.run(bus);
  }
  return {read_truth(options.truth_path), bus.torque_permille};
}

std::vector<FaultConfig> feeder_faults(const std::string& text) {
  const std::string path = temporary("base_faults.json");
  std::ofstream(path) << text;
  return load_faults(path, 14, 10);
}

TEST(BenchWithBase, RunsItsDrivesWritesItsAnglesAndReadsItsTorques) {
  BenchOptions options = feeder_options();
  options.robot.gravity_m_s2 = {0.5 * kG, 0.0, -0.8 * kG};
  const FeederRun still = run_feeder(options, 90, 0);
  const std::size_t last = still.truth.rows.size() - 1;
  EXPECT_EQ(still.truth.at(last, "enabled"), 14.0);
  const std::vector<double> look_deg{-20, 30, 6, -4, 5, 5, -6, 4, 3, 6};
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_NEAR(still.truth.at(last, "theta_deg_" + std::to_string(i + 1)), look_deg[i], 0.01);
  EXPECT_LT(std::fabs(still.truth.at(last, "theta_deg_1") + 20), 1e-3);
  const double weight_N = 2.64 * 0.5 * kG, permille_per_N = 1000 * 0.012 / 5;
  EXPECT_NEAR(static_cast<std::int16_t>(still.torque_permille[0]), permille_per_N * weight_N, 1.0);
  EXPECT_GT(still.truth.at(last, "tension_motor_min_N"), 10.0);
  options.robot.gravity_m_s2.x *= -1.0;
  EXPECT_NEAR(static_cast<std::int16_t>(run_feeder(options, 90, 0).torque_permille[0]), -permille_per_N * weight_N,
              1.0);
}

TEST(BenchWithBase, ASlidesCountsMoveTheTipAlongX) {
  BenchOptions options = feeder_options();
  options.start_pose = "zero";
  options.robot.gravity_m_s2 = {};
  const Truth truth = run_feeder(options, 150, 4).truth;  // every cable by 4 counts a slot as well: 1 mm in all
  const std::size_t last = truth.rows.size() - 1;
  EXPECT_LT(truth.at(last, "theta_deg_1"), -0.1) << "the slide's drive counts the other way round";
  EXPECT_NEAR(truth.at(last, "tip_x_m") - truth.at(0, "tip_x_m"), 0.005 * truth.at(last, "theta_deg_1"), 1e-6);
}

TEST(BenchWithBase, RefusesFaultsOfCablesThatSlideAndRollDoNotHave) {
  for (const char* kind : {"slack", "cable_break", "cable_slip", "load_cell_failed"}) {
    for (const int drive : {1, 2}) {
      BenchOptions options = feeder_options();
      std::string fault = R"({"drive":[4,)" + std::to_string(drive) + R"(],"kind":")" + kind + R"(","at_slot":60)";
      if (std::string(kind) == "cable_slip") fault += R"(,"length_m":0.001)";
      options.faults = feeder_faults("[" + fault + "}]");
      try {
        Bench bench(options);
        ADD_FAILURE() << kind << " was accepted";
      } catch (const std::runtime_error& error) {
        EXPECT_TRUE(names(error.what(), {kind, drive == 1 ? "slide" : "roll", "3", "14"}));
      }
    }
  }
  BenchOptions crossed = feeder_options();
  crossed.cross_wired = {1, 5};
  EXPECT_THROW(Bench{crossed}, std::runtime_error);
  BenchOptions cells = feeder_options();
  cells.buses.load_cells = {{20, 0, {0, 3}, {0.0, 0.0}}};
  EXPECT_THROW(Bench{cells}, std::runtime_error);
}

TEST(BenchWithBase, OnlySlideAndRollOfAFullArmJam) {
  const auto refuses = [](const BenchOptions& options, const std::vector<std::string>& words) {
    try {
      Bench bench(options);
      ADD_FAILURE() << "was accepted";
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(names(error.what(), words)) << error.what();
    }
  };
  BenchOptions options = feeder_options();
  options.faults = feeder_faults(R"([{"drive":3,"kind":"jammed","at_slot":60}])");
  refuses(options, {"jammed", "3", "1 and 2"});
  options.faults = feeder_faults(R"([{"drive":[1,2],"kind":"jammed","at_slot":60}])");
  EXPECT_NO_THROW(Bench{options});
  options.arm = "light", options.physics = "ideal", options.robot.gravity_m_s2 = {};
  refuses(options, {"jammed", "light"});
  BenchOptions without_base = options_of(1);
  without_base.faults = feeder_faults(R"([{"drive":1,"kind":"jammed","at_slot":60}])");
  refuses(without_base, {"jammed", "no such base"});
}

// What holds the slide pulls back by 50 N for each millimetre that its drive has gone on, and lets go when it ends.
TEST(BenchWithBase, AJammedSlidePullsBackAtItsDriveUntilItIsFree) {
  BenchOptions options = feeder_options();
  options.start_pose = "zero";
  options.robot.gravity_m_s2 = {};
  const double m_per_slot = 4 * 2 * 3.14159265358979323846 * 0.012 / 16384, permille_per_N = 1000 * 0.012 / 5;
  options.faults = feeder_faults(R"([{"drive":1,"kind":"jammed","at_slot":90}])");
  const FeederRun jammed = run_feeder(options, 150, 4);
  const std::size_t last = jammed.truth.rows.size() - 1;
  const auto slid_m = [last](const Truth& truth) {  // since it was caught
    return 0.005 * std::fabs(truth.at(last, "theta_deg_1") - truth.at(89, "theta_deg_1"));
  };
  const double way_m = (150 - 90) * m_per_slot;
  EXPECT_GT(slid_m(jammed.truth), 0.7 * way_m) << "the drive is stronger";
  EXPECT_NEAR(std::abs(static_cast<std::int16_t>(jammed.torque_permille[0])),
              permille_per_N * 5e4 * slid_m(jammed.truth), 5.0);
  options.faults = feeder_faults(R"([{"drive":1,"kind":"jammed","at_slot":90,"for_slots":20}])");
  const FeederRun freed = run_feeder(options, 150, 4);
  EXPECT_GT(slid_m(freed.truth), 0.7 * way_m);
  EXPECT_LT(std::abs(static_cast<std::int16_t>(freed.torque_permille[0])), 5.0);
}

TEST(BenchWithBase, FaultsOfItsDrivesAndOfItsCablesHappen) {
  BenchOptions options = feeder_options();
  options.faults =
      feeder_faults(R"([{"drive":1,"kind":"sto","at_slot":70},{"drive":2,"kind":"encoder_jump","counts":500,
                                 "at_slot":70},{"drive":3,"kind":"cable_break","at_slot":70}])");
  const Truth truth = run_feeder(options, 140, 0).truth;
  EXPECT_EQ(truth.at(139, "enabled"), 13.0);
  EXPECT_EQ(truth.at(139, "tension_min_N"), 0.0);
  const double jump_deg = 500 * 2 * 3.14159265358979323846 * 0.012 / 16384 / 0.05 / kRadPerDeg;
  EXPECT_NEAR(truth.at(139, "theta_deg_2"), 30 - jump_deg, 0.2) << "the servo goes by what it reads";
  EXPECT_NEAR(truth.at(139, "theta_deg_1"), -20, 0.05);
}

}  // namespace
}  // namespace liana::bench
