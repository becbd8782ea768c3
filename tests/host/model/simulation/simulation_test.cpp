// How the simulated arm moves, held against the bench's arm: eighty hinges and fifteen cables, integrated in steps of
// 1 ms without any linearisation.
#include "host/model/simulation/simulation.hpp"

#include <gtest/gtest.h>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "hil/arm/arm_physics.hpp"
#include "host/model/clearance/self_clearance.hpp"
#include "tests/host/model/simulation/simulated_arm.hpp"

namespace liana::simulation {
namespace {

using zhu2022::Random;

const config::SceneConfig kNothing{};

// From one pose to another in `seconds`, as evenly as a minimum jerk, and standing there for a second.
JointSequence way(const ThetaVector& from_rad, const ThetaVector& to_rad, double seconds) {
  JointSequence sequence{{0.02, {}}, {}, {}};
  for (int i = 0; i * 0.02 <= seconds + 1.0; ++i) {
    const double s = std::min(1.0, i * 0.02 / seconds);
    const double share = s * s * s * (10.0 + s * (6.0 * s - 15.0));
    ThetaVector row{};
    for (std::size_t k = 0; k < row.size(); ++k) row[k] = from_rad[k] + share * (to_rad[k] - from_rad[k]);
    sequence.rows_rad.push_back(row);
  }
  return sequence;
}

ThetaVector turned(ThetaVector theta_rad, double max_deg, std::uint64_t seed) {
  const ThetaVector change = Random(seed).theta(zhu2022::table(), max_deg);
  for (std::size_t k = 0; k < zhu2022::kThetas; ++k) theta_rad[k] += change[k];
  return theta_rad;
}

// The bench's arm without friction, its drums where the cables of the angles told are as tight as the tensions wanted.
class BenchArm {
 public:
  explicit BenchArm(const ThetaVector& start_rad)
      : robot_(bench::load_robot(CLOSED_LOOP_DATA "/robot.json")),
        truth_(bench::table_parameters(robot_, "ideal")),
        paths_(robot_),
        arm_(robot_, emptied(bench::load_scene(CLOSED_LOOP_DATA "/scene.json")), truth_, theta(start_rad)) {
    start_payout_m_ = arm_.payouts_m();
    paths_.update(theta(start_rad));
    for (std::size_t c = 0; c < 15; ++c) start_length_m_[c] = paths_.length_m(c);
    for (std::size_t c = 0; c < 15; ++c) start_tension_N_[c] = arm_.motor_tension_N(c);
    told_m_ = start_payout_m_;
  }

  // Follows the drives' lag in steps of 1 ms for one interval.
  void interval(const ThetaVector& from_rad, const ThetaVector& to_rad, double tau_s) {
    for (int i = 1; i <= 20; ++i) {
      bench::Theta told{};
      for (std::size_t k = 0; k < 10; ++k) told[k] = from_rad[k] + (to_rad[k] - from_rad[k]) * i / 20.0;
      paths_.update(told);
      // The same tensions at rest: what a change of length brings is paid out.
      bench::CableValues wanted{};
      for (std::size_t c = 0; c < 15; ++c)
        wanted[c] =
            start_payout_m_[c] + (paths_.length_m(c) - start_length_m_[c]) / (1.0 + start_tension_N_[c] / truth_.EA_N);
      for (std::size_t c = 0; c < 15; ++c) told_m_[c] += (wanted[c] - told_m_[c]) * (1.0 - std::exp(-0.001 / tau_s));
      arm_.step(0.001, told_m_);
    }
  }
  const bench::Theta& theta_rad() const { return arm_.theta_rad(); }
  double tension_N(std::size_t cable) const { return arm_.motor_tension_N(cable); }

 private:
  static bench::SceneConfig emptied(bench::SceneConfig scene) {
    scene.boxes.clear();
    scene.spheres.clear();
    return scene;
  }
  static bench::Theta theta(const ThetaVector& theta_rad) {
    bench::Theta out{};
    std::copy_n(theta_rad.begin(), out.size(), out.begin());
    return out;
  }

  bench::RobotConfig robot_;
  bench::TrueParameters truth_;
  bench::CablePaths paths_;
  bench::ArmPhysics arm_;
  bench::CableValues start_payout_m_{}, told_m_{};
  std::array<double, 15> start_length_m_{}, start_tension_N_{};
};

// req:C1
TEST(Simulation, MovesAsTheBenchsFullDynamicsDoes) {
  ArmModel model = zhu2022_model();
  model.table.friction_mu = 0.0;
  model.swing_damping_1_s = 0.0;  // the core is not in the loop here
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const ThetaVector from_rad = turned(zhu2022::radians(zhu2022::kPrepare_deg), 4.0, seed);
    // Drums that go where the angles are, with no thought of the arm's mass.
    JointSequence told = way(from_rad, turned(from_rad, 0.2, seed + 100), 3.0);
    told.loads_Nm.assign(told.rows_rad.size(), ThetaVector{});
    told.tensions_N.assign(told.rows_rad.size(), CableVector{});
    BenchArm truth(from_rad);
    StartState start;
    start.theta_rad = from_rad;
    for (std::size_t c = 0; c < 15; ++c) start.tension_N[c] = truth.tension_N(c);
    Simulation simulation(model, kNothing);
    const Motion& motion = simulation.run(start, told);
    ASSERT_TRUE(motion.solved);
    double worst_rad = 0.0, lag_rad = 0.0, worst_N = 0.0, change_N = 0.0;
    for (std::size_t row = 1; row < told.rows_rad.size(); ++row) {
      truth.interval(told.rows_rad[row - 1], told.rows_rad[row], model.table.servo_time_constant_s);
      const Moment& moment = motion.moments[row * kStepsPerInterval];
      for (std::size_t k = 0; k < 10; ++k) {
        worst_rad = std::max(worst_rad, std::fabs(moment.theta_rad[k] - truth.theta_rad()[k]));
        lag_rad = std::max(lag_rad, std::fabs(told.rows_rad[row][k] - truth.theta_rad()[k]));
      }
      for (std::size_t c = 0; c < 15; ++c) {
        worst_N = std::max(worst_N, std::fabs(moment.tension_N[c] - truth.tension_N(c)));
        change_N = std::max(change_N, std::fabs(truth.tension_N(c) - start.tension_N[c]));
      }
    }
    RecordProperty("worst_deg_" + std::to_string(seed), std::to_string(worst_rad / kDegree));
    printf("seed %d: sim against truth %.4f deg (told against truth %.4f), tension %.2f N (changes by %.2f)\n",
           static_cast<int>(seed), worst_rad / kDegree, lag_rad / kDegree, worst_N, change_N);
    EXPECT_LT(worst_rad, 0.3 * lag_rad) << "what is told says less than a third as well where the arm is";
    EXPECT_LT(worst_rad, 0.005 * kDegree);
  }
}

TEST(Simulation, AnArmThatIsToldToStandStands) {
  StartState start;
  start.theta_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const JointSequence told{{0.02, std::vector<ThetaVector>(20, start.theta_rad)}, {}, {}};
  Simulation simulation(zhu2022_model(), kNothing);
  for (const Moment& moment : simulation.run(start, told).moments) {
    EXPECT_EQ(moment.theta_rad, start.theta_rad);
    EXPECT_EQ(moment.tip_rate_rad_s, 0.0);
  }
}

// A measured arm that stands beside what it is told keeps its distance: friction holds it there.
TEST(Simulation, BeginsWhereTheArmIsMeasuredAndNotWhereItIsTold) {
  StartState start;
  const ThetaVector told_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
  start.theta_rad = turned(told_rad, 0.1, 1);
  Simulation simulation(zhu2022_model(), kNothing);
  const Motion& motion = simulation.run(start, {{0.02, std::vector<ThetaVector>(20, told_rad)}, {}, {}});
  EXPECT_EQ(motion.moments.back().theta_rad, start.theta_rad);
}

// One plate, and the same plate drawn elsewhere: what counts is where it stands.
TEST(Simulation, ASceneThatStandsBesideItsDrawingIsMetWhereItStands) {
  const Pose stands{{0.012, -0.007, 0.004}, normalize({1.0, 0.004, -0.006, 0.005})};
  config::SceneBox plate{"plate", {2.0, 0.3, 0.0}, {1.0, 0.01, 1.0}, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  config::SceneConfig drawn, there;
  drawn.boxes = {plate};
  plate.center_m = add(rotate(stands.quaternion, plate.center_m), stands.position_m);
  for (Vec3& axis : plate.rotation) axis = rotate(stands.quaternion, axis);
  there.boxes = {plate};
  StartState start;
  start.theta_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const JointSequence told = way(start.theta_rad, turned(start.theta_rad, 1.0, 7), 1.0);
  Simulation simulated(zhu2022_model(), there), as_drawn(zhu2022_model(), drawn), beside(zhu2022_model(), drawn);
  const Motion& expected = simulated.run(start, told);
  const double drawn_m = as_drawn.run(start, told).distances.scene.distance_m;
  start.drawing_in_base = stands;
  const Motion& motion = beside.run(start, told);
  EXPECT_NEAR(motion.distances.scene.distance_m, expected.distances.scene.distance_m, 1e-9);
  EXPECT_NEAR(motion.distances.scene_at_start_m, expected.distances.scene_at_start_m, 1e-9);
  EXPECT_NEAR(motion.distances.scene_at_end_m, expected.distances.scene_at_end_m, 1e-9);
  EXPECT_NEAR(motion.distances.scene.link, expected.distances.scene.link, 1) << "two links meet in a joint";
  EXPECT_GT(std::fabs(motion.distances.scene.distance_m - drawn_m), 0.003);
}

// Every link counts: the nearest to the ball is the last one, and both ends of the arm come near each other.
// req:C7
TEST(Simulation, ArmsOfAsManyModulesAsTheCoreServesAreMeasuredWhole) {
  for (const RobotParams& table : long_tables()) {
    const ArmModel model = model_of(table);
    StartState start;
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); k += 2)
      start.theta_rad[k] = 350.0 * kDegree / (table.segment_count * table.segment[0].modules);
    const cable::LinkPoints links = link_points(table, start.theta_rad);
    const auto last = static_cast<std::size_t>(links.count) - 2;
    config::SceneConfig ball;
    ball.spheres = {{"ball", links.point_in_base[last + 1], 0.001}};
    clearance::SelfClearance nearest;
    const std::int32_t apart = clearance::min_apart(table.segment[0].theta_limit_rad);
    for (std::int32_t i = 0; i < links.count - 1; ++i) {
      for (std::int32_t k = i + apart; k < links.count - 1; ++k) {
        const double here_m = between_m(clearance::link_capsule(links.axis(), i, model.link_radius_m),
                                        clearance::link_capsule(links.axis(), k, model.link_radius_m));
        if (here_m < nearest.nearest_m) nearest = {here_m, i, k};
      }
    }
    Simulation simulation(model, ball);
    const Distances& found = simulation.run(start, {{0.02, {start.theta_rad, start.theta_rad}}, {}, {}}).distances;
    EXPECT_NEAR(found.scene.distance_m, -0.001 - model.link_radius_m, 1e-9);
    EXPECT_EQ(found.scene.link, static_cast<std::int32_t>(last));
    EXPECT_NEAR(found.self.distance_m, nearest.nearest_m, 1e-9);
    EXPECT_EQ(found.self.link, nearest.link);
    EXPECT_EQ(found.self.other, nearest.other);
  }
}

TEST(Simulation, TheDrumsLagBehindARampByTheirTimeConstant) {
  const eigen::ThetaColumn rate = eigen::ThetaColumn::Constant(1, 0.03);
  eigen::ThetaColumn told = eigen::ThetaColumn::Zero(1);
  DrumLag<eigen::ThetaColumn> lag(0.03, 0.01, told, 0.0 * rate);
  for (int i = 0; i < 100; ++i) lag.step(told += 0.01 * rate);
  EXPECT_NEAR(lag.now()[0], told[0] - 0.03 * 0.03, 1e-12);
  DrumLag<eigen::ThetaColumn> moving(0.03, 0.01, told, rate);
  moving.step(told + 0.01 * rate);
  EXPECT_NEAR(moving.now()[0], told[0] + 0.01 * 0.03 - 0.03 * 0.03, 1e-15) << "a motion that goes on has no jolt";
}

// Straight lines between rows: no step leaves what two rows keep.
// req:C7
TEST(Simulation, StepsBetweenTwoRowsStayBetweenThem) {
  ArmModel stiff = zhu2022_model();
  stiff.table.cable_EA_N *= 1e3;
  stiff.table.servo_time_constant_s = 0.0;
  StartState start;
  start.theta_rad = zhu2022::radians(zhu2022::kPrepare_deg);
  const JointSequence told = way(start.theta_rad, turned(start.theta_rad, 1.0, 7), 1.0);
  Simulation simulation(stiff, kNothing);
  const Motion& motion = simulation.run(start, told);
  for (std::size_t row = 1; row < told.rows_rad.size(); ++row) {
    for (std::size_t k = 0; k < 10; ++k) {
      const double middle = motion.moments[row * kStepsPerInterval - 1].theta_rad[k];
      EXPECT_NEAR(middle, 0.5 * (told.rows_rad[row - 1][k] + told.rows_rad[row][k]), 2e-5);
    }
  }
}

TEST(Simulation, AWayThatLeavesThePoseFarBehindIsSolvedAnew) {
  ArmModel model = zhu2022_model();
  model.table.friction_mu = 0.0;
  const ThetaVector from_rad = zhu2022::radians(zhu2022::kPrepare_deg),
                    to_rad = zhu2022::radians(zhu2022::kPanelEdge_deg);
  StartState start;
  start.theta_rad = from_rad;
  Simulation simulation(model, kNothing);
  const Motion& motion = simulation.run(start, way(from_rad, to_rad, 20.0));
  ASSERT_TRUE(motion.solved);
  for (std::size_t k = 0; k < 10; ++k) EXPECT_NEAR(motion.moments.back().theta_rad[k], to_rad[k], 0.02 * kDegree);
  // Tensions at the end are those that hold the arm still there.
  const CablePaths paths = cable_paths(model, to_rad);
  const auto tension_N = Eigen::Map<const CableColumn>(motion.moments.back().tension_N.data(), 15);
  EXPECT_LT((paths.jacobian_m_rad.transpose() * tension_N).cwiseAbs().maxCoeff(), 2.0);
}

}  // namespace
}  // namespace liana::simulation
