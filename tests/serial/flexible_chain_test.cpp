// The bench's elastic arm: energy, static deflection, rotors against links, friction, the sensor at the wrist.
#include "hil/serial/flexible_chain.hpp"

#include <cmath>

#include "firmware_like/serial/dynamics.hpp"
#include "firmware_like/serial/kinematics.hpp"
#include "tests/serial/both_tables.hpp"

namespace liana::test {
namespace {

using bench::FlexibleChain;
using bench::RotorDrive;
using bench::TipLoad;
using bench::TipState;

constexpr double kStep_s = FlexibleChain::kStep_s;
const bench::BodyConfig kPayload{500.0, {0.0, 0.0, 0.5}, {500.0 / 6, 500.0 / 6, 500.0 / 6, 0, 0, 0}};

TipLoad nothing(const TipState&) { return {}; }

std::vector<double> pose_rad(const bench::SerialRobotConfig& robot, const char* name) {
  return robot.named_poses_rad.at(name);
}

bench::SerialRobotConfig table(const char* name) { return bench_robot(config::good_table("robot", name)); }

bench::SerialRobotConfig without_losses(bench::SerialRobotConfig robot) {
  robot.coulomb_Nm = robot.viscous_Nms_per_rad = robot.gear_damping_Nms_per_rad = 0.0;
  if (!robot.base) return robot;
  auto base = std::make_shared<bench::LockedBaseConfig>(*robot.base);
  base->damping_s = 0.0;
  robot.base = base;
  return robot;
}

// Motors give torque for half a second, then none; returns the energy from then on, every tenth of a second.
std::vector<double> energies(FlexibleChain& arm, double seconds) {
  std::vector<RotorDrive> drives(7, RotorDrive{true, 0.0, 0.0});
  for (std::size_t i = 0; i < 7; ++i) drives[i].torque_Nm = i % 2 == 0 ? 40.0 : -25.0;
  for (double t = 0.0; t < 0.5; t += kStep_s) arm.step(kStep_s, drives, nothing);
  for (RotorDrive& drive : drives) drive.torque_Nm = 0.0;
  std::vector<double> out;
  for (int tenth = 0; tenth < 10.0 * seconds; ++tenth) {
    out.push_back(arm.energy_J());
    for (int i = 0; i < 400; ++i) arm.step(kStep_s, drives, nothing);
  }
  return out;
}

TEST(FlexibleChain, WithoutLossesEnergyStays) {
  for (const char* name : {"micro", "macro_micro"}) {
    const bench::SerialRobotConfig robot = without_losses(table(name));
    FlexibleChain arm(robot, pose_rad(robot, "install"), kPayload);
    const std::vector<double> energy = energies(arm, 5.0);
    ASSERT_GT(energy[0], 0.5) << name;
    for (const double now : energy) EXPECT_NEAR(now, energy[0], 2e-4 * energy[0]) << name;
  }
}

TEST(FlexibleChain, FrictionAndDampingTakeEnergyAndGiveNone) {
  const bench::SerialRobotConfig robot = table("macro_micro");
  FlexibleChain arm(robot, pose_rad(robot, "install"), kPayload);
  const std::vector<double> energy = energies(arm, 3.0);
  for (std::size_t i = 1; i < energy.size(); ++i) EXPECT_LE(energy[i], energy[i - 1] * (1.0 + 1e-6));
  EXPECT_LT(energy.back(), 0.5 * energy[0]);
}

// Half a step is a quarter of the error, against steps of a sixteenth.
TEST(FlexibleChain, HalfTheStepIsAQuarterOfTheError) {
  const bench::SerialRobotConfig robot = without_losses(table("micro"));
  const auto end_m = [&robot](double step_s) {
    FlexibleChain arm(robot, pose_rad(robot, "install"), kPayload);
    std::vector<RotorDrive> drives(7, RotorDrive{true, 20.0, 0.0});
    for (int i = 0; i < std::lround(0.5 / step_s); ++i) arm.step(step_s, drives, nothing);
    return arm.tip().pose.position_m;
  };
  const bench::Vec3 exact = end_m(0.002 / 16);
  const double whole = norm(end_m(0.002) - exact), half = norm(end_m(0.001) - exact);
  EXPECT_GT(whole / half, 3.5);
}

// The tip's way under a force, by the core's kinematics of both arms: C = J Kq^-1 J^T with the springs of the base and
// of the gears.
Vec3 deflection_m(const config::SerialRobotConfig& pair, const bench::SerialRobotConfig& robot, const Vec3& force_N) {
  const serial::ArmKinematics base = serial::forward_kinematics(pair.base->table, pair.base->joint_rad);
  serial::JointVector joint{};
  for (std::size_t i = 0; i < 7; ++i) joint[i] = pose_rad(robot, "install")[i];
  const serial::ArmKinematics arm = serial::forward_kinematics(pair.table, joint);
  const Quat& turn = base.tip_in_base.quaternion;
  const Vec3 lever = rotate(turn, arm.tip_in_base.position_m);
  Vec3 moved{};
  for (std::size_t i = 0; i < 7; ++i) {
    const Vec3 of_base = add(base.tip_jacobian.linear[i], cross(base.tip_jacobian.angular[i], lever));
    const Vec3 of_arm = rotate(turn, arm.tip_jacobian.linear[i]);
    moved = add(moved, scale(of_base, dot(of_base, force_N) / pair.base->stiffness_Nm_rad[i]));
    moved = add(moved, scale(of_arm, dot(of_arm, force_N) / robot.stiffness_Nm_rad[i]));
  }
  return moved;
}

// req:B12
TEST(FlexibleChain, ABrakedArmOnItsLockedBaseGivesWayAsItsCompliance) {
  const Json json = config::good_table("robot", "macro_micro");
  const config::SerialRobotConfig pair = config::parse_serial_robot(json.dump(), "r");
  bench::SerialRobotConfig robot = without_losses(bench_robot(json));
  auto base = std::make_shared<bench::LockedBaseConfig>(*robot.base);
  base->damping_s = 2.0;  // so that it settles soon
  robot.base = base;
  robot.gear_damping_Nms_per_rad = 1e4;
  for (const Vec3& force_N : {Vec3{0.01, 0, 0}, Vec3{0, 0.01, 0}, Vec3{0, 0, 0.01}}) {
    FlexibleChain arm(robot, pose_rad(robot, "install"));
    const bench::Vec3 start = arm.tip().pose.position_m;
    const TipLoad load{{force_N[0], force_N[1], force_N[2]}, {}};
    for (int i = 0; i < 8000; ++i)
      arm.step(0.05, std::vector<RotorDrive>(7), [&load](const TipState&) { return load; });
    const bench::Vec3 moved = arm.tip().pose.position_m - start;
    const Vec3 expected = deflection_m(pair, robot, force_N);
    const double size = norm(expected);
    EXPECT_NEAR(moved.x, expected[0], 2e-3 * size);
    EXPECT_NEAR(moved.y, expected[1], 2e-3 * size);
    EXPECT_NEAR(moved.z, expected[2], 2e-3 * size);
  }
}

// Stiff gears and light rotors: the links accelerate as the core's dynamics say.
TEST(FlexibleChain, BehindStiffGearsTheLinksMoveAsTheCoresDynamicsSay) {
  const Json json = config::good_table("robot", "micro");
  const config::SerialRobotConfig host = config::parse_serial_robot(json.dump(), "r");
  bench::SerialRobotConfig robot = without_losses(bench_robot(json));
  robot.rotor_inertia_kgm2 = 0.0;
  serial::JointMotion motion;
  for (std::size_t i = 0; i < 7; ++i) motion.joint_rad[i] = pose_rad(robot, "install")[i];
  for (std::size_t i = 0; i < 7; ++i) motion.accel_rad_s2[i] = i % 2 == 0 ? 0.1 : -0.05;
  serial::Dynamics dynamics(host.table, host.masses);
  dynamics.set_payload({kPayload.mass_kg, {0.0, 0.0, 0.5}, kPayload.inertia_kgm2});
  const serial::Wrench push{{5.0, -3.0, 2.0}, {1.0, 0.5, -2.0}};
  const serial::JointVector torque = dynamics.torque_Nm(motion, push);
  FlexibleChain arm(robot, pose_rad(robot, "install"), kPayload);
  std::vector<RotorDrive> drives(7, RotorDrive{true, 0.0, 0.0});
  for (std::size_t i = 0; i < 7; ++i) drives[i].torque_Nm = torque[i];
  const TipLoad load{{5.0, -3.0, 2.0}, {1.0, 0.5, -2.0}};
  arm.step(1e-5, drives, [&load](const TipState&) { return load; });
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(arm.joint_rate_rad_s(i) / 1e-5, motion.accel_rad_s2[i], 1e-4) << i;
}

TEST(FlexibleChain, BelowItsDryFrictionAJointDoesNotCreep) {
  const bench::SerialRobotConfig robot = table("micro");
  FlexibleChain arm(robot, pose_rad(robot, "install"));
  const TipLoad load{{0.5, 0.3, -0.4}, {}};  // less than 8 N m about any joint
  const std::vector<RotorDrive> free(7, RotorDrive{true, 0.0, 0.0});
  for (int i = 0; i < 20000; ++i) {
    arm.step(0.001, free, [&load](const TipState&) { return load; });
    for (std::size_t k = 0; k < 7; ++k)
      ASSERT_LT(std::fabs(arm.joint_rad(k) - pose_rad(robot, "install")[k]), bench::CoulombFriction::kGive_rad);
  }
}

TEST(FlexibleChain, ABrakedJointFeelsTheLoadInItsGearAndTheWristFeelsIt) {
  const Json json = config::good_table("robot", "micro");
  const config::SerialRobotConfig host = config::parse_serial_robot(json.dump(), "r");
  bench::SerialRobotConfig robot = bench_robot(json);
  robot.coulomb_Nm = 0.0;
  robot.gear_damping_Nms_per_rad = 20000.0;  // so that it settles soon
  FlexibleChain arm(robot, pose_rad(robot, "install"), kPayload);
  const TipLoad load{{0.0, 20.0, -10.0}, {3.0, 0.0, 0.0}};
  for (int i = 0; i < 20000; ++i)
    arm.step(0.004, std::vector<RotorDrive>(7), [&load](const TipState&) { return load; });
  serial::JointMotion rest;
  for (std::size_t i = 0; i < 7; ++i) rest.joint_rad[i] = arm.joint_rad(i);
  const serial::JointVector held =
      serial::Dynamics(host.table, host.masses).torque_Nm(rest, {{0.0, 20.0, -10.0}, {3.0, 0.0, 0.0}});
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(arm.gear_Nm(i), held[i], 0.02) << i;
  EXPECT_NEAR(norm(arm.wrist().force_N), std::sqrt(500.0), 0.01);
  EXPECT_NEAR(norm(arm.wrist().torque_Nm), 3.0, 0.01);
}

// Thrown by its base, the wrist feels the payload's inertia: m a of its centre.
TEST(FlexibleChain, TheWristFeelsWhatAcceleratesThePayload) {
  const bench::SerialRobotConfig robot = without_losses(table("micro"));
  FlexibleChain arm(robot, pose_rad(robot, "install"), kPayload);
  std::vector<RotorDrive> drives(7, RotorDrive{true, 30.0, 0.0});
  const auto center = [&arm] { return arm.tip().pose.position_m + rotate(arm.tip().pose.attitude, kPayload.center_m); };
  for (int i = 0; i < 2000; ++i) arm.step(kStep_s, drives, nothing);
  const bench::Vec3 first = center();
  arm.step(kStep_s, drives, nothing);
  const bench::Vec3 second = center();
  const bench::Vec3 felt = rotate(arm.tip().pose.attitude, arm.wrist().force_N);
  arm.step(kStep_s, drives, nothing);
  const bench::Vec3 third = center();
  const bench::Vec3 accel = (1.0 / (kStep_s * kStep_s)) * (third - 2.0 * second + first);
  const bench::Vec3 inertia = -kPayload.mass_kg * accel;
  ASSERT_GT(norm(inertia), 1.0);
  EXPECT_LT(norm(felt - inertia), 0.05 * norm(inertia));
}

TEST(FlexibleChain, AnArmWithoutStiffnessIsRefused) {
  bench::SerialRobotConfig robot = table("micro");
  robot.stiffness_Nm_rad.clear();
  try {
    FlexibleChain arm(robot, pose_rad(robot, "install"));
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("stiffness_Nm_per_rad"), std::string::npos);
  }
}

}  // namespace
}  // namespace liana::test
