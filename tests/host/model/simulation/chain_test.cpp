// The simulation's kinematics, inertia and cables, held against the core's closed forms and the bench's physics, with
// neither of which they share anything.
#include "host/model/simulation/chain.hpp"

#include <gtest/gtest.h>

#include "firmware_like/cable/arm/cables.hpp"
#include "hil/arm/cable_geometry.hpp"
#include "hil/arm/chain.hpp"
#include "host/model/config/config.hpp"
#include "host/model/simulation/cable_paths.hpp"
#include "tests/host/model/simulation/simulated_arm.hpp"

namespace liana::simulation {
namespace {

using zhu2022::Random;

const std::vector<RobotParams>& tables() {
  static const std::vector<RobotParams> all = [] {
    std::vector<RobotParams> out = long_tables();
    out.insert(out.end(), {zhu2022::table(), zhu2022::uneven_table()});
    return out;
  }();
  return all;
}

// req:A35
TEST(Chain, LinksAreWhereTheCoresClosedFormHasThem) {
  Random random(1);
  for (const RobotParams& table : tables()) {
    for (int i = 0; i < 50; ++i) {
      const ThetaVector theta_rad = random.theta(table, 20.0);
      Chain chain;
      place(model_of(table), theta_rad, chain);
      const LinkPoints core = link_points(table, theta_rad);
      ASSERT_EQ(chain.links + 1, core.count);
      for (std::size_t k = 0; k < static_cast<std::size_t>(core.count); ++k)
        EXPECT_LT((chain.point_m[k] - eigen::view(core.point_in_base[k])).norm(), 1e-12) << "point " << k;
    }
  }
}

// MuJoCo takes them in several files.
// req:A35
TEST(Chain, TheBenchPutsArmsOfAsManyModulesAsTheCoreServesThere) {
  Random random(3);
  for (const RobotParams& table : long_tables()) {
    bench::RobotConfig robot = bench::load_robot(CLOSED_LOOP_DATA "/robot.json");
    robot.segments.resize(static_cast<std::size_t>(table.segment_count), robot.segments.front());
    for (bench::SegmentConfig& segment : robot.segments) {
      segment.modules = table.segment[0].modules;
      segment.module_length_m = table.segment[0].module_length_m;
      segment.face_offset_m = table.segment[0].face_offset_m;
    }
    bench::Chain hinges(robot, bench::load_scene(CLOSED_LOOP_DATA "/scene.json"));
    const ThetaVector theta_rad = random.theta(table, 5.0);
    bench::Theta at{};
    std::copy_n(theta_rad.begin(), at.size(), at.begin());
    hinges.place(at);
    const LinkPoints core = link_points(table, theta_rad);
    ASSERT_EQ(hinges.link_count() + 1, static_cast<std::size_t>(core.count));
    for (std::size_t k = 0; k <= hinges.link_count(); ++k) {
      const bench::Vec3 point_m = hinges.joint_center_m(k);
      const Vec3 there_m{point_m.x, point_m.y, point_m.z};
      EXPECT_LT(norm(subtract(there_m, core.point_in_base[k])), 1e-9) << "point " << k;
    }
  }
}

void expect_mass_of_hinges(const ArmModel& model, const std::string& robot_file, double max_deg, double share) {
  bench::Chain hinges(bench::load_robot(robot_file), bench::load_scene(CLOSED_LOOP_DATA "/scene.json"));
  Random random(2);
  const auto thetas = static_cast<std::size_t>(model.table.theta_count());
  for (int i = 0; i < 10; ++i) {
    const ThetaVector theta_rad = random.theta(model.table, max_deg);
    Chain chain;
    place(model, theta_rad, chain);
    const eigen::ThetaMatrix mass = mass_matrix(model, chain);
    bench::Theta at{};
    std::copy_n(theta_rad.begin(), at.size(), at.begin());
    bench::ThetaMatrix reference{};
    hinges.place(at);
    hinges.inertia(reference);
    for (std::size_t a = 0; a < thetas; ++a) {
      for (std::size_t b = 0; b < thetas; ++b)
        EXPECT_NEAR(mass(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)), reference[a][b],
                    share * mass(0, 0));
    }
  }
}

// req:A4
TEST(Chain, TheReducedMassMatrixIsThatOfEightyHinges) {
  expect_mass_of_hinges(zhu2022_model(), CLOSED_LOOP_DATA "/robot.json", 20.0, 1e-6);
}

TEST(Chain, TheReducedMassMatrixHasTheToolInIt) {
  const config::RobotConfig lab = config::load_robot(CLOSED_LOOP_DATA "/lab_1g.json", "nominal",
                                                     config::load_buses(CLOSED_LOOP_DATA "/buses.json"));
  ASSERT_GT(lab.table.tool.mass_kg, 0.0);
  expect_mass_of_hinges(arm_model(lab), CLOSED_LOOP_DATA "/lab_1g.json", 15.0, 1e-4);
}

// Sums of as many as 128 modules, in another order.
TEST(CablePaths, LengthsChangeWithTheAnglesAsTheCoreSays) {
  Random random(3);
  for (const RobotParams& table : tables()) {
    const CableLayout layout = cable_layout(table);
    for (int i = 0; i < 50; ++i) {
      const ThetaVector theta_rad = random.theta(table, 20.0);
      const CablePaths paths = cable_paths(model_of(table), theta_rad);
      const CableGeometry core = cable_geometry(table, layout, arm_trig(table, theta_rad));
      for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
        const auto row = static_cast<Eigen::Index>(c);
        for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k)
          EXPECT_NEAR(paths.jacobian_m_rad(row, static_cast<Eigen::Index>(k)), core.jacobian_m_rad[c][k], 1e-11);
        EXPECT_NEAR(paths.stiffness_N_per_m[row], table.cable_EA_N / (core.length_m[c] + table.lead_m), 1e-3);
      }
    }
  }
}

// With other holes and discs in each segment.
// req:A11
TEST(CablePaths, AreAsLongAsTheBenchsAndTheCoresAndWrapRoundTheHolesAsTheBenchsDo) {
  auto robot = bench::load_robot(CLOSED_LOOP_DATA "/robot.json");
  RobotParams table = zhu2022::table();
  for (std::size_t m = 0; m < 5; ++m) {
    table.segment[m].hole_radius_m = robot.segments[m].hole_radius_m = 0.025 - 0.002 * static_cast<double>(m);
    table.segment[m].face_offset_m = robot.segments[m].face_offset_m = m % 2 == 0 ? 0.013 : 0.008;
  }
  bench::CablePaths reference(robot);
  const CableLayout layout = cable_layout(table);
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const ThetaVector theta_rad = i == 0 ? ThetaVector{} : random.theta(table, 20.0);
    const CablePaths paths = cable_paths(model_of(table), theta_rad);
    const CableGeometry core = cable_geometry(table, layout, arm_trig(table, theta_rad));
    bench::Theta at{};
    std::copy_n(theta_rad.begin(), at.size(), at.begin());
    reference.update(at);
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      double wrap_rad = 0.0;
      for (std::size_t m = 0; m <= reference.last_segment(c); ++m) wrap_rad += reference.path(c, m).wrap_rad;
      EXPECT_NEAR(paths.wrap_rad[static_cast<Eigen::Index>(c)], wrap_rad, 1e-6);
      EXPECT_NEAR(core.length_m[c], reference.length_m(c), 1e-12);
      EXPECT_NEAR(layout.zero_length_m[c], robot.path_at_zero_m(c / 3), 1e-12);
      EXPECT_NEAR(paths.stiffness_N_per_m[static_cast<Eigen::Index>(c)],
                  table.cable_EA_N / (reference.length_m(c) + table.lead_m), 1e-6);
    }
  }
}

TEST(CablePaths, BalancedTensionsHoldTheArmStillAndStayTaut) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const CablePaths paths = cable_paths(zhu2022_model(), random.theta(zhu2022::table(), 20.0));
    const CableColumn tension_N = balanced_tensions(paths, CableColumn::Constant(15, 40.0), 20.0);
    const eigen::ThetaColumn torque_Nm = paths.jacobian_m_rad.transpose() * tension_N;
    EXPECT_LT(torque_Nm.cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_GE(tension_N.minCoeff(), 19.9);
    EXPECT_LE(tension_N.maxCoeff(), 150.0);
  }
}

}  // namespace
}  // namespace liana::simulation
