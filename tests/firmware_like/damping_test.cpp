// Damping of the arm's slow modes.
#include "firmware_like/cable/motion/damping.hpp"

#include <gtest/gtest.h>

#include "firmware_like/cable/arm/estimator.hpp"
#include "firmware_like/cable/arm/tension.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

struct Bench {
  explicit Bench(double mu = 0.0) : robot(zhu2022::table(mu)) {}
  RobotParams robot;
  ThetaVector theta = zhu2022::radians(zhu2022::kPanelEdge_deg);
  CableLayout layout = cable_layout(robot);
  ArmTrig trig = arm_trig(robot, theta);
  CableGeometry geometry = cable_geometry(robot, layout, trig);
  TensionRatio ratio = tension_ratio(robot, layout, trig, SlipState{});
  CableVector planned_N = plan_tension(robot, geometry, ratio, SegmentVector{}).motor_N;

  // Tensions when the arm hangs `deflection` away from where its motors want it.
  CableVector pulled(const ThetaVector& deflection) const {
    CableVector tension = planned_N;
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      double stretch_m = 0.0;
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k) stretch_m += geometry.jacobian_m_rad[c][k] * deflection[k];
      tension[c] += stretch_m * robot.cable_EA_N / (geometry.length_m[c] + robot.lead_m);
    }
    return tension;
  }
  ThetaVector step(const CableVector& measured_N, DampingState& state) const {
    CableSolver solver;
    update_cable_solver(robot, geometry, solver);
    const CableVector planned_m = payout_for(robot, layout, geometry.part_m, ratio, planned_N);
    const CableVector measured_m = payout_for(robot, layout, geometry.part_m, ratio, measured_N);
    CableVector stretch_m{};
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) stretch_m[c] = planned_m[c] - measured_m[c];
    damp(robot, geometry, solver, stretch_m, state);
    return state.output_rad;
  }
};

TEST(Damping, AnArmThatHangsWhereItShouldIsLeftAlone) {
  const Bench bench;
  DampingState state;
  for (std::int32_t i = 0; i < 100; ++i) EXPECT_EQ(zhu2022::length(bench.step(bench.planned_N, state)), 0.0);
}

TEST(Damping, MotorsGoAfterTheDeflection) {
  const Bench bench;
  ThetaVector deflection{};
  deflection[3] = 0.02 * kDegree;
  DampingState state;
  ThetaVector shift{};
  for (std::int32_t i = 0; i < 50; ++i) shift = bench.step(bench.pulled(deflection), state);
  EXPECT_GT(shift[3], 0.1 * deflection[3]);
  EXPECT_LT(shift[3], deflection[3]);
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) EXPECT_TRUE(k == 3 || std::fabs(shift[k]) < 0.05 * shift[3]) << k;
}

TEST(Damping, AStandingDeflectionIsForgotten) {
  const Bench bench;
  ThetaVector deflection{};
  deflection[0] = 0.05 * kDegree;
  DampingState state;
  double most = 0.0;
  ThetaVector shift{};
  for (std::int32_t i = 0; i < 20000; ++i) {
    shift = bench.step(bench.pulled(deflection), state);
    most = std::max(most, shift[0]);
  }
  EXPECT_GT(most, 0.2 * deflection[0]);
  EXPECT_LT(std::fabs(shift[0]), 0.01 * most);
}

TEST(Damping, TheShiftIsNeverMoreThanACorrection) {
  const Bench bench;
  ThetaVector deflection{};
  deflection[1] = 2.0 * kDegree;
  DampingState state;
  for (std::int32_t i = 0; i < 2000; ++i) {
    for (double angle : bench.step(bench.pulled(deflection), state)) ASSERT_LE(std::fabs(angle), kDampingLimit_rad);
  }
}

// One mode of the arm on elastic cables, s'' = -w^2 (s - motor), behind servo lag and tension filter. Returns the
// amplitude after `time_s`.
double amplitude_after(double frequency_hz, bool damped, double time_s) {
  const Bench bench;
  const RobotParams& robot = bench.robot;
  const double w = 2.0 * kPi * frequency_hz, start = 0.02 * kDegree;
  constexpr std::int32_t kSubsteps = 40;
  const double h = robot.tick_s / kSubsteps;
  const std::size_t k = 4;
  DampingState state;
  CableVector filtered_N = bench.planned_N;
  double swing = start, rate = 0.0, motor = 0.0, command = 0.0, amplitude = 0.0;
  const auto ticks = static_cast<std::int32_t>(time_s / robot.tick_s);
  for (std::int32_t i = 0; i < ticks; ++i) {
    const double acting = command;  // drives act one tick late
    ThetaVector deflection{};
    deflection[k] = swing - motor;
    const CableVector measured_N = bench.pulled(deflection);
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      filtered_N[c] += robot.tick_s / (kTensionFilter_s + robot.tick_s) * (measured_N[c] - filtered_N[c]);
    }
    if (damped) command = bench.step(filtered_N, state)[k];
    for (std::int32_t n = 0; n < kSubsteps; ++n) {
      motor += h / robot.servo_time_constant_s * (acting - motor);
      rate -= h * w * w * (swing - motor);
      swing += h * rate;
    }
    amplitude = std::sqrt(swing * swing + rate * rate / (w * w));
  }
  return amplitude / start;
}

// Over the arm's whole range of modes (physics study, section 4: 0.37 to 13 Hz), not only near the one it was tuned
// for.
TEST(Damping, EveryModeOfTheArmDecaysAndNoneWithoutIt) {
  for (const double frequency_hz : {0.4, 0.6, 1.0, 1.8, 3.0, 5.0, 9.0, 13.0}) {
    EXPECT_GT(amplitude_after(frequency_hz, false, 10.0), 0.99) << frequency_hz;
    EXPECT_LT(amplitude_after(frequency_hz, true, 10.0), 0.25) << frequency_hz;
    EXPECT_LT(amplitude_after(frequency_hz, true, 20.0), 0.06) << frequency_hz;
  }
}

}  // namespace
}  // namespace liana::cable
