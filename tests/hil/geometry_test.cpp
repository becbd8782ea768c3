// Cable lengths, tip and inertia of the bench against three independent witnesses: golden values, MuJoCo's tendons,
// finite differences.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "fixtures.hpp"
#include "hil/arm/cable_geometry.hpp"
#include "hil/arm/chain.hpp"

namespace liana::bench {
namespace {

nlohmann::json golden_cases() {
  std::ifstream file(GOLDEN_DATA "/arm.json");
  return nlohmann::json::parse(file).at("cases");
}

Theta theta_of(const nlohmann::json& test) {
  Theta theta{};
  for (std::size_t i = 0; i < 10; ++i) theta[i] = kRadPerDeg * test.at("theta_deg").at(i).get<double>();
  return theta;
}

// The fixture's arm with other holes and discs in each segment.
RobotConfig uneven_robot() {
  RobotConfig robot = fixture_robot();
  for (std::size_t m = 0; m < robot.segments.size(); ++m) {
    robot.segments[m].hole_radius_m -= 0.002 * static_cast<double>(m);
    robot.segments[m].face_offset_m += m % 2 == 0 ? 0.003 : -0.002;
  }
  return robot;
}

// req:A11
TEST(BenchGeometry, CableLengthsAreTheGoldenOnesToANanometre) {
  const RobotConfig robot = fixture_robot();
  CablePaths paths(robot);
  for (const auto& test : golden_cases()) {
    paths.update(theta_of(test));
    for (std::size_t c = 0; c < 15; ++c)
      EXPECT_NEAR(paths.length_m(c), test.at("cable_length_m").at(c).get<double>(), 1e-9) << test.at("name");
  }
}

// req:A35
TEST(BenchGeometry, TheTipIsTheGoldenOneToANanometre) {
  Chain chain(fixture_robot(), fixture_scene());
  for (const auto& test : golden_cases()) {
    chain.place(theta_of(test));
    const Pose tip = chain.tip();
    const Vec3 axes[3] = {rotate(tip.attitude, {1, 0, 0}), rotate(tip.attitude, {0, 1, 0}),
                          rotate(tip.attitude, {0, 0, 1})};
    const auto& pose = test.at("tip_pose");
    EXPECT_LT(norm(tip.position_m - Vec3{pose[0][3], pose[1][3], pose[2][3]}), 1e-9) << test.at("name");
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT(norm(axes[k] - Vec3{pose[0][k], pose[1][k], pose[2][k]}), 1e-9) << test.at("name");
  }
}

// req:A36
TEST(BenchGeometry, ThePointJacobianOfTheTipIsTheGoldenOne) {
  Chain chain(fixture_robot(), fixture_scene());
  for (const auto& test : golden_cases()) {
    chain.place(theta_of(test));
    PointJacobian jacobian;
    chain.point_jacobian(39, chain.tip().position_m, jacobian);
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t i = 0; i < 10; ++i)
        EXPECT_NEAR(jacobian[row][i], test.at("jacobian").at(row).at(i).get<double>(), 1e-9);
  }
}

TEST(BenchGeometry, MujocoTendonsThroughTheHolesAgreeOverAThousandRandomPoses) {
  for (const RobotConfig& robot : {fixture_robot(), uneven_robot()}) {
    Chain chain(robot, fixture_scene(), true);
    CablePaths paths(robot);
    for (std::size_t c = 0; c < 15; ++c) EXPECT_NEAR(paths.length_m(c), robot.path_at_zero_m(c / 3), 1e-12);
    Random random(7, "tendon poses");
    double worst_m = 0.0;
    for (int pose = 0; pose < 1000; ++pose) {
      const Theta theta = random_theta(random, 20.0);
      chain.place(theta);
      paths.update(theta);
      const auto tendons = chain.tendon_lengths_m();
      ASSERT_EQ(tendons.size(), 15U);
      for (std::size_t c = 0; c < 15; ++c) worst_m = std::max(worst_m, std::fabs(tendons[c] - paths.length_m(c)));
    }
    EXPECT_LT(worst_m, 1e-6);
  }
}

// req:A3 req:A8
TEST(BenchGeometry, AnUnevenLinkageKeepsEverySegmentsMeanAndMujocoTendonsAgree) {
  const RobotConfig robot = fixture_robot();
  const Linkage linkage = uneven_linkage(robot, 0.05, 3);
  ASSERT_EQ(linkage.size(), 40U);
  for (std::size_t first = 0; first < 40; first += 8) {
    BendShare mean{0.0, 0.0};
    double most = 0.0;
    for (std::size_t i = first; i < first + 8; ++i) {
      mean = {mean.pitch + linkage[i].pitch / 8.0, mean.yaw + linkage[i].yaw / 8.0};
      most = std::max({most, std::fabs(linkage[i].pitch - 1.0), std::fabs(linkage[i].yaw - 1.0)});
    }
    EXPECT_NEAR(mean.pitch, 1.0, 1e-14);
    EXPECT_NEAR(mean.yaw, 1.0, 1e-14);
    EXPECT_GT(most, 0.01);
    EXPECT_LT(most, 0.1);
  }
  Chain chain(robot, fixture_scene(), true);
  chain.set_linkage(linkage);
  CablePaths paths(robot, 0.0, linkage), even(robot);
  Random random(12, "uneven poses");
  double worst_m = 0.0, max_apart_m = 0.0;
  for (int pose = 0; pose < 100; ++pose) {
    const Theta theta = random_theta(random, 20.0);
    chain.place(theta);
    paths.update(theta);
    even.update(theta);
    const auto tendons = chain.tendon_lengths_m();
    for (std::size_t c = 0; c < 15; ++c) {
      worst_m = std::max(worst_m, std::fabs(tendons[c] - paths.length_m(c)));
      max_apart_m = std::max(max_apart_m, std::fabs(paths.length_m(c) - even.length_m(c)));
    }
  }
  EXPECT_LT(worst_m, 1e-6);
  EXPECT_GT(max_apart_m, 1e-5) << "an uneven linkage that changes no cable is none";
}

// The work of the weight is the change of height of the links' middles.
// req:A46
TEST(BenchGeometry, WeightAndAnUnevenLinkageActByTheDerivativesOfHeightAndTip) {
  const RobotConfig robot = fixture_robot();
  Chain chain(robot, fixture_scene());
  chain.set_gravity({0.0, 0.0, -2.0});
  chain.set_linkage(uneven_linkage(robot, 0.05, 4));
  const auto height_J = [&](const Theta& theta) {
    chain.place(theta);
    double sum_m = 0.0;
    for (std::size_t i = 0; i < chain.link_count(); ++i)
      sum_m += 0.5 * (chain.joint_center_m(i).z + chain.joint_center_m(i + 1).z);
    return 2.0 * robot.segments[0].module_mass_kg * sum_m;
  };
  constexpr double kStep = 1e-5;
  Random random(13, "weight poses");
  Theta theta = random_theta(random, 15.0);
  chain.place(theta);
  Theta weight_Nm;
  chain.bias(Theta{}, weight_Nm);
  PointJacobian jacobian;
  chain.point_jacobian(39, chain.tip().position_m, jacobian);
  for (std::size_t i = 0; i < 10; ++i) {
    const double middle = theta[i];
    theta[i] = middle + kStep;
    const double above_J = height_J(theta);
    const Vec3 ahead_m = chain.tip().position_m;
    theta[i] = middle - kStep;
    const double below_J = height_J(theta);
    const Vec3 moved_m = ahead_m - chain.tip().position_m;
    theta[i] = middle;
    EXPECT_NEAR(weight_Nm[i], (above_J - below_J) / (2.0 * kStep), 1e-5) << "theta " << i;
    EXPECT_NEAR(jacobian[0][i], moved_m.x / (2.0 * kStep), 1e-6);
    EXPECT_NEAR(jacobian[1][i], moved_m.y / (2.0 * kStep), 1e-6);
    EXPECT_NEAR(jacobian[2][i], moved_m.z / (2.0 * kStep), 1e-6);
  }
}

TEST(BenchGeometry, CableDerivativesAreTheDifferencesOfLengths) {
  const RobotConfig robot = uneven_robot();
  CablePaths paths(robot);
  Random random(8, "derivative poses");
  for (int pose = 0; pose < 50; ++pose) {
    Theta theta = random_theta(random, 20.0);
    paths.update(theta);
    const CableJacobian jacobian = paths.jacobian();
    for (std::size_t i = 0; i < 10; ++i) {
      constexpr double kStep = 1e-6;
      const double middle = theta[i];
      CablePaths ahead = paths;
      CablePaths behind = paths;
      theta[i] = middle + kStep;
      ahead.update(theta);
      theta[i] = middle - kStep;
      behind.update(theta);
      theta[i] = middle;
      for (std::size_t c = 0; c < 15; ++c)
        EXPECT_NEAR(jacobian[c][i], (ahead.length_m(c) - behind.length_m(c)) / (2.0 * kStep), 1e-8)
            << "cable " << c << " theta " << i;
    }
  }
}

// req:A3 req:A4
TEST(BenchGeometry, TheReducedInertiaIsTheFullOneBetweenSelections) {
  Chain chain(fixture_robot(), fixture_scene());
  Random random(9, "inertia poses");
  for (int pose = 0; pose < 20; ++pose) {
    chain.place(random_theta(random, 20.0));
    ThetaMatrix reduced;
    chain.inertia(reduced);
    const auto full = chain.full_inertia();
    ASSERT_EQ(full.size(), 80U * 80U);
    ThetaMatrix expected{};
    for (std::size_t i = 0; i < 80; ++i)
      for (std::size_t j = 0; j < 80; ++j)
        expected[chain.theta_of_hinge(i)][chain.theta_of_hinge(j)] += full[80 * i + j];
    for (std::size_t a = 0; a < 10; ++a)
      for (std::size_t b = 0; b < 10; ++b) EXPECT_NEAR(reduced[a][b], expected[a][b], 1e-9 * std::fabs(expected[a][a]));
  }
}

TEST(BenchGeometry, ReducedBiasForcesAreTheChangeOfMomentumAlongTheMotion) {
  // For constant rates: bias = dM/dt v - 1/2 d(v^T M v)/dtheta, by differences of M.
  Chain chain(fixture_robot(), fixture_scene());
  Random random(10, "bias poses");
  const Theta theta = random_theta(random, 15.0);
  const Theta rate = random_theta(random, 10.0);
  const auto inertia_at = [&](const Theta& at) {
    ThetaMatrix mass;
    chain.place(at);
    chain.inertia(mass);
    return mass;
  };
  const auto product = [](const ThetaMatrix& m, const Theta& v, std::size_t row) {
    double sum = 0.0;
    for (std::size_t b = 0; b < 10; ++b) sum += m[row][b] * v[b];
    return sum;
  };
  chain.place(theta);
  Theta bias;
  chain.bias(rate, bias);
  constexpr double kStep = 1e-5;
  Theta ahead = theta;
  Theta behind = theta;
  for (std::size_t i = 0; i < 10; ++i) {
    ahead[i] += kStep * rate[i];
    behind[i] -= kStep * rate[i];
  }
  const ThetaMatrix m_ahead = inertia_at(ahead);
  const ThetaMatrix m_behind = inertia_at(behind);
  for (std::size_t i = 0; i < 10; ++i) {
    Theta up = theta;
    Theta down = theta;
    up[i] += kStep;
    down[i] -= kStep;
    const ThetaMatrix m_up = inertia_at(up);
    const ThetaMatrix m_down = inertia_at(down);
    double kinetic = 0.0;
    for (std::size_t a = 0; a < 10; ++a) kinetic += 0.5 * rate[a] * (product(m_up, rate, a) - product(m_down, rate, a));
    const double expected = (product(m_ahead, rate, i) - product(m_behind, rate, i) - kinetic) / (2.0 * kStep);
    EXPECT_NEAR(bias[i], expected, 1e-5 + 1e-5 * std::fabs(expected)) << "theta " << i;
  }
}

}  // namespace
}  // namespace liana::bench
