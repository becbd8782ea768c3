// The serial arm on the bench: its kinematics, the torque of its motions, and its drives behind a scripted master.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bench_harness.hpp"
#include "hil/serial/serial_plant.hpp"

namespace liana::bench {
namespace {

SerialRobotConfig micro() { return load_serial_robot(HIL_DATA "/micro.json"); }

std::vector<double> radians(std::vector<double> joint_deg) {
  for (double& angle : joint_deg) angle *= kRadPerDeg;
  return joint_deg;
}

TEST(SerialBench, TipAgreesWithTheProductOfExponentials) {
  std::ifstream file(GOLDEN_DATA "/micro.json");
  const auto golden = nlohmann::json::parse(file);
  JointChain chain(micro());
  ASSERT_GE(golden["cases"].size(), 50U);
  for (const auto& entry : golden["cases"]) {
    chain.place(radians(entry["joint_deg"]));
    const Pose tip = chain.tip();
    const Vec3 axis[3] = {rotate(tip.attitude, {1, 0, 0}), rotate(tip.attitude, {0, 1, 0}),
                          rotate(tip.attitude, {0, 0, 1})};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(axis[k].x, entry["tip_pose"][0][k].get<double>(), 1e-9) << entry["name"];
      EXPECT_NEAR(axis[k].y, entry["tip_pose"][1][k].get<double>(), 1e-9) << entry["name"];
      EXPECT_NEAR(axis[k].z, entry["tip_pose"][2][k].get<double>(), 1e-9) << entry["name"];
    }
    EXPECT_NEAR(tip.position_m.x, entry["tip_pose"][0][3].get<double>(), 1e-9) << entry["name"];
    EXPECT_NEAR(tip.position_m.y, entry["tip_pose"][1][3].get<double>(), 1e-9) << entry["name"];
    EXPECT_NEAR(tip.position_m.z, entry["tip_pose"][2][3].get<double>(), 1e-9) << entry["name"];
  }
}

// Stretched, the first joint turns all masses about the base's z axis.
TEST(SerialBench, TorqueOfTheFirstJointIsTheWholeArmsInertia) {
  JointChain chain(micro());
  chain.place(std::vector<double>(7, 0.0));
  const auto torque = chain.torque_Nm(std::vector<double>(7, 0.0), {1, 0, 0, 0, 0, 0, 0});
  const double spheres = 8 * 0.4 * 30 * 0.15 * 0.15 + 0.4 * (40 - 30) * 0.15 * 0.15;
  const auto at = [](double mass_kg, double x_m, double y_m) { return mass_kg * (x_m * x_m + y_m * y_m); };
  // Modules at the origins of the joints' frames, read off the stretched arm; booms as thin rods.
  const double modules = at(30, 0, 0) + at(30, 0, 0) + at(30, 0, -0.22) + at(30, 2.1, -0.22) + at(30, 4.2, -0.22) +
                         at(30, 4.2, -0.22) + at(30, 4.2, 0) + at(40, 4.2, 0);
  const double booms = 2 * 25 * (2.1 * 2.1 / 12.0) + at(25, 1.05, -0.22) + at(25, 3.15, -0.22);
  EXPECT_NEAR(torque[0], 10.0 + spheres + modules + booms, 0.05);  // the rods are 0.1 m thick
}

TEST(SerialBench, NothingAtRestNeedsTorque) {
  JointChain chain(micro());
  chain.place(radians({10, 60, -30, 100, -40, 60, 20}));
  for (const double torque : chain.torque_Nm(std::vector<double>(7, 0.0), std::vector<double>(7, 0.0)))
    EXPECT_NEAR(torque, 0.0, 1e-9);
}

BenchOptions options_for(bool spread) {
  BenchOptions options;
  options.serial_robot = micro();
  options.scene = fixture_scene();
  options.buses = load_buses(HIL_DATA "/micro_buses.json");
  options.spread = spread;
  options.truth_path = temporary("serial_truth.bin");
  options.summary_path = temporary("serial_summary.json");
  return options;
}

Truth run_on(const BenchOptions& options, ScriptedBus& bus) {
  Bench bench(options);
  bench.run(bus);
  return read_truth(options.truth_path);
}

// 20 counts a slot are 0.0069 deg in 4 ms: 1.7 deg/s.
TEST(SerialBench, DrivesTakeTheJointsWithThem) {
  ScriptedBus bus(400, 20, 7, 4);
  const Truth truth = run_on(options_for(false), bus);
  EXPECT_EQ(bus.boot_ups, 7);
  EXPECT_GT(bus.tpdos, 7 * 300);
  const std::size_t last = truth.rows.size() - 1;
  EXPECT_EQ(truth.at(last, "enabled"), 7.0);
  for (int i = 1; i <= 7; ++i) {
    const std::string column = "joint_deg_" + std::to_string(i);
    const double moved_deg = truth.at(last, column) - truth.at(0, column);
    EXPECT_NEAR(moved_deg * (i % 2 == 1 ? 1.0 : -1.0), 20.0 * 310 * 360.0 / 1048576, 0.2) << i;
  }
}

// Stretched, both booms of 2.1 m lie along x.
TEST(SerialBench, TheTruthTellsHowFarTheArmIsFromABodyAndHowDeepInIt) {
  const SerialRobotConfig robot = micro();
  JointChain chain(robot);
  const std::vector<Vec3> axis = chain.axis_m();
  double length_m = 0.0;
  for (std::size_t i = 1; i < axis.size(); ++i) length_m += norm(axis[i] - axis[i - 1]);
  double drawn_m = -robot.joints[0].d_m;  // about which the first joint turns
  for (const JointConfig& joint : robot.joints) drawn_m += std::fabs(joint.d_m) + std::fabs(joint.a_m);
  EXPECT_NEAR(length_m, drawn_m, 1e-9);
  EXPECT_LT(norm(axis.back() - chain.tip().position_m), 1e-12);

  const auto boom = std::find_if(axis.begin() + 1, axis.end(),
                                 [&](const Vec3& end) { return std::fabs(norm(end - *(&end - 1)) - 2.1) < 1e-9; });
  ASSERT_NE(boom, axis.end());
  const Vec3 middle = 0.5 * (*boom + *(boom - 1));
  for (const double away_m : {0.6, 0.28, 0.2}) {
    BenchOptions options = options_for(false);
    options.scene = {};
    options.scene.spheres.push_back({"ball", middle + Vec3{0.0, 0.0, away_m}, 0.1});
    options.start_pose = "zero";
    ScriptedBus bus(20, 0, 7, 4);
    const Truth truth = run_on(options, bus);
    EXPECT_NEAR(truth.at(0, "clearance_m"), away_m - 0.1 - robot.link_radius_m, 1e-9);
  }
}

TEST(SerialBench, BrakedJointsStandStill) {
  ScriptedBus bus(39, 0, 7, 4);
  const Truth truth = run_on(options_for(true), bus);
  for (int i = 1; i <= 7; ++i) {
    const std::string column = "joint_deg_" + std::to_string(i);
    EXPECT_EQ(truth.at(truth.rows.size() - 1, column), truth.at(0, column));
  }
}

// The tip of the real arm is some millimetres from where the table says, as the source states for arms of this size.
TEST(SerialBench, TheTrueArmDiffersFromTheTableBySeed) {
  double largest_m = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const TrueArm arm = true_arm(micro(), "prepare", true, true, seed);
    JointChain real(arm.robot), table(micro());
    std::vector<double> read = arm.start_rad;
    for (std::size_t i = 0; i < read.size(); ++i) read[i] -= arm.zero_offset_rad[i];
    real.place(arm.start_rad);
    table.place(read);
    const double off_m = norm(real.tip().position_m - table.tip().position_m);
    EXPECT_GT(off_m, 1e-5) << seed;
    largest_m = std::max(largest_m, off_m);
  }
  EXPECT_GT(largest_m, 0.002);
  EXPECT_LT(largest_m, 0.015);
}

TEST(SerialBench, FaultsOfCablesAreRefusedByName) {
  BenchOptions options = options_for(false);
  FaultConfig fault;
  fault.drives = {0};
  fault.kind = FaultKind::kCableBreak;
  fault.name = "cable_break";
  fault.at_slot = 5;
  options.faults = {fault};
  try {
    Bench bench(options);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("cable_break"), std::string::npos);
  }
}

TEST(SerialBench, ADrivesFaultHappensToTheDriveThatIsNamed) {
  BenchOptions options = options_for(false);
  FaultConfig fault;
  fault.drives = {2};
  fault.kind = FaultKind::kFault;
  fault.name = "fault";
  fault.at_slot = 200;
  options.faults = {fault};
  ScriptedBus bus(300, 0, 7, 4);
  const Truth truth = run_on(options, bus);
  EXPECT_EQ(truth.at(199, "enabled"), 7.0);
  EXPECT_EQ(truth.at(truth.rows.size() - 1, "enabled"), 6.0);
}

}  // namespace
}  // namespace liana::bench
