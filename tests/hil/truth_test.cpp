// Every column of the truth against what else is known of the same arm: a recorder that is wrong hides what happened.
#include <cmath>

#include "bench_harness.hpp"
#include "hil/arm/arm_physics.hpp"
#include "hil/arm/kinematic_arm.hpp"
#include "hil/bench/drive_bank.hpp"

namespace liana::bench {
namespace {

ArmPhysics arm_at(const std::string& pose, const std::string& physics = "nominal",
                  const SceneConfig& scene = fixture_scene()) {
  const RobotConfig robot = fixture_robot();
  return ArmPhysics(robot, scene, table_parameters(robot, physics), start_pose(robot, pose, 0.0, 1));
}

Truth truth_of(BenchOptions options, std::uint32_t slots, int counts_per_slot) {
  options.truth_path = temporary("truth_columns.bin");
  {
    Bench bench(options);
    ScriptedBus bus(slots, counts_per_slot);
    bench.run(bus);
  }
  return read_truth(options.truth_path);
}

Theta theta_of(const Truth& truth, std::size_t row) {
  Theta theta{};
  for (std::size_t i = 0; i < 10; ++i) theta[i] = kRadPerDeg * truth.at(row, "theta_deg_" + std::to_string(i + 1));
  return theta;
}

Vec3 tip_of(const Truth& truth, std::size_t row) {
  return {truth.at(row, "tip_x_m"), truth.at(row, "tip_y_m"), truth.at(row, "tip_z_m")};
}

TEST(TruthColumns, TipSpeedDepthRateAndClearancesAreThoseOfTheAngles) {
  const BenchOptions options = options_of(4);
  const Truth truth = truth_of(options, 400, 7);
  Chain chain(options.robot, options.scene);
  const Vec3 u = rotate(options.scene.slit_frame->attitude, {1.0, 0.0, 0.0});
  double fastest_tip_m_s = 0.0;
  for (std::size_t row = 1; row < truth.rows.size(); ++row) {
    const Theta theta = theta_of(truth, row);
    const Theta before = theta_of(truth, row - 1);
    const Vec3 tip = tip_of(truth, row);
    const Pose expected = liana::bench::tip_of(options.robot, theta);
    EXPECT_LT(norm(tip - expected.position_m), 1e-9);
    EXPECT_NEAR(truth.at(row, "tip_qw") * expected.attitude.w + truth.at(row, "tip_qx") * expected.attitude.x +
                    truth.at(row, "tip_qy") * expected.attitude.y + truth.at(row, "tip_qz") * expected.attitude.z,
                1.0, 1e-9);
    EXPECT_NEAR(truth.at(row, "tip_speed_m_s"), norm(tip - tip_of(truth, row - 1)) / kSlot_s, 1e-9);
    EXPECT_NEAR(truth.at(row, "slit_depth_m"), dot(u, tip - options.scene.slit_frame->position_m), 1e-9);
    double turned_deg_s = 0.0;
    for (std::size_t i = 0; i < 10; ++i)
      turned_deg_s = std::max(turned_deg_s, std::fabs(theta[i] - before[i]) / kRadPerDeg / kSlot_s);
    EXPECT_NEAR(truth.at(row, "fastest_deg_s"), turned_deg_s, 0.2 + 0.2 * turned_deg_s);
    chain.place(theta);
    const Clearance gap = clearance_of(chain, options.scene, options.robot.module_radius_m);
    EXPECT_NEAR(truth.at(row, "slit_clearance_m"), gap.slit_m, 1e-9);
    EXPECT_NEAR(truth.at(row, "sphere_clearance_m"), gap.sphere_m, 1e-9);
    EXPECT_EQ(truth.at(row, "clearance_m"),
              std::min(truth.at(row, "slit_clearance_m"), truth.at(row, "sphere_clearance_m")));
    fastest_tip_m_s = std::max(fastest_tip_m_s, truth.at(row, "tip_speed_m_s"));
  }
  EXPECT_GT(fastest_tip_m_s, 0.001) << "the arm has to move, or nothing is compared";
}

TEST(TruthColumns, TensionsAtMotorsAreWhatTheDrivesMeasure) {
  BenchOptions options = options_of(5);
  options.truth_path = temporary("truth_tension.bin");
  ScriptedBus bus(300, 3);
  {
    Bench bench(options);
    bench.run(bus);
  }
  const Truth truth = read_truth(options.truth_path);
  const std::size_t last = truth.rows.size() - 1;
  const auto [least, most] = std::minmax_element(bus.torque_permille.begin(), bus.torque_permille.end());
  constexpr double kNewtonsPerPermille = 0.6;
  EXPECT_NEAR(truth.at(last, "tension_motor_min_N"), kNewtonsPerPermille * *least,
              0.03 * kNewtonsPerPermille * *least + 0.6);
  EXPECT_NEAR(truth.at(last, "tension_motor_max_N"), kNewtonsPerPermille * *most,
              0.03 * kNewtonsPerPermille * *most + 0.6);
}

TEST(TruthColumns, TheRodsForceIsRecorded) {
  BenchOptions options = options_of(6);
  options.start_pose = "press_rod";
  options.fixture = true;
  options.robot = fixture_robot();
  const Truth truth = truth_of(options, 20, 0);
  EXPECT_NEAR(truth.at(5, "rod_force_N"), 0.5, 0.05) << "50 N/m, one radius deep";
  BenchOptions far = options_of(6);
  EXPECT_EQ(truth_of(far, 20, 0).at(5, "rod_force_N"), 0.0);
}

// Reeling in raises the tension at the motor; friction keeps it from the far end.
TEST(TruthRecord, TheLeastTensionIsTheLeastAnywhereAlongAnyCable) {
  ArmPhysics arm = arm_at("panel_edge", "worn");
  CableValues payout = arm.payouts_m();
  for (std::size_t c = 0; c < 15; ++c) payout[c] -= 1e-4;
  (void)arm.take_record();
  arm.step(kStep_s, payout);
  const LoadRecord loads = arm.take_record();
  double anywhere_N = 1e9, motor_N = 1e9;
  for (std::size_t c = 0; c < 15; ++c) {
    anywhere_N = std::min(anywhere_N, arm.least_tension_N(c));
    motor_N = std::min(motor_N, arm.motor_tension_N(c));
  }
  EXPECT_EQ(loads.least_tension_N, anywhere_N);
  EXPECT_EQ(loads.min_motor_tension_N, motor_N);
  EXPECT_LT(loads.least_tension_N, motor_N - 0.5) << "friction has to make a difference";
}

TEST(TruthRecord, ContactAndTensionsAreTheExtremesOfEveryStepSinceItWasTaken) {
  ArmPhysics each = arm_at("press_rod", "nominal", squeezed_scene(0.012));
  ArmPhysics once = arm_at("press_rod", "nominal", squeezed_scene(0.012));
  const CableValues payout = each.payouts_m();
  LoadRecord most;
  double last_contact_N = 0.0;
  for (int i = 0; i < 200; ++i) {
    each.begin_slot(kSlot_s), once.begin_slot(kSlot_s);
    each.step(kStep_s, payout), once.step(kStep_s, payout);
    const LoadRecord step = each.take_record();
    last_contact_N = step.contact_N;
    most.contact_N = std::max(most.contact_N, step.contact_N);
    most.least_tension_N = std::min(most.least_tension_N, step.least_tension_N);
    most.min_motor_tension_N = std::min(most.min_motor_tension_N, step.min_motor_tension_N);
    most.max_motor_tension_N = std::max(most.max_motor_tension_N, step.max_motor_tension_N);
  }
  const LoadRecord all = once.take_record();
  EXPECT_EQ(all.contact_N, most.contact_N);
  EXPECT_EQ(all.least_tension_N, most.least_tension_N);
  EXPECT_EQ(all.min_motor_tension_N, most.min_motor_tension_N);
  EXPECT_EQ(all.max_motor_tension_N, most.max_motor_tension_N);
  EXPECT_GT(all.contact_N, last_contact_N + 1.0) << "the peak must not be the last value";
  EXPECT_EQ(once.take_record().contact_N, 0.0) << "taking it begins anew";
}

TEST(TruthRecord, AContactsForceHoldsItsFriction) {
  ArmPhysics arm = arm_at("press_rod", "nominal", squeezed_scene(0.012));
  const auto contacts = arm.chain().contacts();
  ASSERT_FALSE(contacts.empty());
  const ContactConfig law = fixture_scene().contact;
  Theta rate{};
  for (std::size_t i = 0; i < 10; ++i) rate[i] = 0.02;
  ContactLoad sliding, standing;
  add_contact(law, arm.chain(), contacts[0], rate, 10, kStep_s, sliding);
  add_contact(law, arm.chain(), contacts[0], Theta{}, 10, kStep_s, standing);
  PointJacobian jacobian;
  arm.chain().point_jacobian(contacts[0].link, contacts[0].point_m, jacobian);
  Vec3 velocity;
  for (std::size_t i = 0; i < 10; ++i)
    velocity = velocity + rate[i] * Vec3{jacobian[0][i], jacobian[1][i], jacobian[2][i]};
  const double leaving_m_s = dot(velocity, contacts[0].normal);
  ASSERT_GT(norm(velocity - leaving_m_s * contacts[0].normal), 0.005) << "it has to slide";
  const double normal_N = law.stiffness_N_per_m * contacts[0].depth_m - law.damping_Ns_per_m * leaving_m_s;
  ASSERT_GT(normal_N, 1.0);
  EXPECT_NEAR(sliding.largest_N, normal_N * std::hypot(1.0, law.friction), 1e-9 * normal_N);
  EXPECT_NEAR(standing.largest_N, law.stiffness_N_per_m * contacts[0].depth_m, 1e-9);
}

template <class SomeArm>
void expect_stop_pushes_inwards(SomeArm& arm, std::size_t angle, double limit_rad) {
  const double beyond_rad = arm.theta_rad()[angle];
  ASSERT_GT(std::fabs(beyond_rad), limit_rad + 0.5 * kRadPerDeg);
  const CableValues payout = arm.payouts_m();
  for (int i = 0; i < 300; ++i) {
    arm.begin_slot(kSlot_s);
    arm.step(kStep_s, payout);
  }
  EXPECT_LT(std::fabs(arm.theta_rad()[angle]), std::fabs(beyond_rad) - 0.1 * kRadPerDeg);
}

TEST(JointStops, PushAnAngleBackIntoItsRange) {
  const RobotConfig robot = fixture_robot();
  const double limit_rad = robot.segments[4].theta_limit_rad;
  for (const double side : {1.0, -1.0}) {
    Theta theta = start_pose(robot, "zero", 0.0, 1);
    theta[8] = side * (limit_rad + 1.0 * kRadPerDeg);
    ArmPhysics full(robot, fixture_scene(), table_parameters(robot, "ideal"), theta);
    expect_stop_pushes_inwards(full, 8, limit_rad);
    KinematicArm light(robot, table_parameters(robot, "ideal"), theta);
    expect_stop_pushes_inwards(light, 8, limit_rad);
  }
}

TEST(TrueParameters, EachIsSpreadByTheSeedOverAllOfItsRange) {
  const RobotConfig robot = fixture_robot();
  struct Range {
    double least = 1e9, most = -1e9;
    void take(double value) { least = std::min(least, value), most = std::max(most, value); }
  };
  Range EA, mu, radius, zero, gain;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const TrueParameters p = spread_parameters(robot, "nominal", seed);
    EA.take(p.EA_N / robot.cable_EA_N), mu.take(p.mu / robot.friction_mu.at("nominal"));
    radius.take(1e3 * p.hole_radius_error_m);
    for (std::size_t c = 0; c < 15; ++c) zero.take(1e3 * p.zero_offset_m[c]), gain.take(p.torque_gain[c]);
    EXPECT_NE(p.zero_offset_m[0], p.zero_offset_m[1]) << "each cable has its own";
    EXPECT_NE(p.torque_gain[0], p.torque_gain[1]);
  }
  const auto expect_range = [](const Range& range, double least, double most) {
    const double margin = 0.05 * (most - least);
    EXPECT_GE(range.least, least);
    EXPECT_LT(range.least, least + margin);
    EXPECT_LE(range.most, most);
    EXPECT_GT(range.most, most - margin);
  };
  expect_range(EA, 0.95, 1.05);
  expect_range(mu, 0.8, 1.2);
  expect_range(radius, -0.02, 0.02);
  expect_range(zero, -0.05, 0.05);
  expect_range(gain, 0.99, 1.01);
}

// What a drive says by SDO about an object.
std::int64_t object_of(DriveBank& bank, std::uint8_t node, std::uint16_t index, std::size_t bytes) {
  FrameList out;
  const auto bus = static_cast<std::uint8_t>(node <= 8 ? 0 : 1);
  const CanFrame ask =
      frame_of(bus, 0x600U + node,
               {0x40, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8), 0, 0, 0, 0, 0});
  bank.exchange({ask}, 1000, out);
  for (const CanFrame& frame : out)
    if (frame.id == 0x580U + node) return static_cast<std::int32_t>(get_little_endian(&frame.data[4], bytes));
  ADD_FAILURE() << "node " << int{node} << " does not answer";
  return 0;
}

TEST(DriveBank, ReadsTorqueWithItsGainAndPositionBesideItsZero) {
  const RobotConfig robot = fixture_robot();
  TrueParameters plain = table_parameters(robot, "ideal");
  TrueParameters off = plain;
  off.torque_gain[4] = 1.25;
  off.zero_offset_m[4] = 0.001;
  CableValues payout{}, tension{};
  for (std::size_t c = 0; c < 15; ++c) payout[c] = 4.0 + robot.lead_m, tension[c] = 60.0;
  DriveBank as_told(robot, fixture_buses(), plain, payout, false, 1);
  DriveBank really(robot, fixture_buses(), off, payout, false, 1);
  for (DriveBank* bank : {&as_told, &really}) {
    FrameList boot;
    bank->measure(tension);
    bank->exchange({}, 500, boot);
    for (std::size_t c = 0; c < 15; ++c) EXPECT_NEAR(bank->payouts_m()[c], payout[c], 1e-12);
  }
  EXPECT_EQ(object_of(as_told, 5, 0x6077, 2), 100);
  EXPECT_EQ(object_of(really, 5, 0x6077, 2), 125);
  EXPECT_EQ(object_of(really, 6, 0x6077, 2), 100);
  const double counts = as_told.drive(4).motor().position_counts() - really.drive(4).motor().position_counts();
  EXPECT_NEAR(counts, robot.drives[4].direction * 0.001 / robot.metres_per_count(), 1e-6);
}

}  // namespace
}  // namespace liana::bench
