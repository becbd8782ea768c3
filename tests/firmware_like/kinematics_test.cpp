// Closed-form kinematics against golden values, the plain DH product, the chain of modules and the 80-joint Jacobian.
#include "firmware_like/cable/arm/kinematics.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include <vector>

#include "firmware_like/cable/arm/cables.hpp"
#include "host/base/json/json.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::largest_difference;
using zhu2022::Random;
using Matrix4 = std::array<std::array<double, 4>, 4>;

const Json& golden() {
  std::ifstream file(LIANA_GOLDEN_DIR "/arm.json");
  static const Json data = Json::parse(std::string{std::istreambuf_iterator<char>(file), {}});
  return data;
}

ThetaVector golden_theta(const Json& entry) { return zhu2022::radians(entry.at("theta_deg").get<zhu2022::Degrees>()); }

Vec3 axis_of(const Quat& q, std::size_t column) {
  Vec3 unit{};
  unit[column] = 1.0;
  return rotate(q, unit);
}

double matrix_difference(const Pose& pose, const Matrix4& matrix) {
  double largest = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 axis = axis_of(pose.quaternion, k);
    for (std::size_t r = 0; r < 3; ++r) largest = std::max(largest, std::fabs(axis[r] - matrix[r][k]));
    largest = std::max(largest, std::fabs(pose.position_m[k] - matrix[k][3]));
  }
  return largest;
}

Matrix4 product(const Matrix4& a, const Matrix4& b) {
  Matrix4 out{};
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t k = 0; k < 4; ++k) out[r][c] += a[r][k] * b[k][c];
    }
  }
  return out;
}

// One row of the source's table: turn about z, along x, tilt about x.
Matrix4 dh_row(double a_m, double alpha_rad, double theta_rad) {
  const double ca = std::cos(alpha_rad), sa = std::sin(alpha_rad), ct = std::cos(theta_rad), st = std::sin(theta_rad);
  return {{{ct, -st * ca, st * sa, a_m * ct}, {st, ct * ca, -ct * sa, a_m * st}, {0, sa, ca, 0}, {0, 0, 0, 1}}};
}

// One axis of the physical chain: where it stands, and which theta turns it.
struct Hinge {
  Vec3 point_m, axis;
  std::size_t theta;
};

// Chain of modules, one rotation after the other: odd ones Rz(pitch) Ry(yaw), even ones Ry(yaw) Rz(pitch), link along
// x.
struct Chain {
  std::vector<Hinge> hinges;  // two per module
  std::vector<Pose> nodes{Pose{}};
};

Chain chain_of(const RobotParams& robot, const ThetaVector& theta) {
  Chain chain;
  Pose at;
  for (std::size_t m = 0; m < static_cast<std::size_t>(robot.segment_count); ++m) {
    for (std::int32_t k = 0; k < robot.segment[m].modules; ++k) {
      for (std::size_t turn = 0; turn < 2; ++turn) {
        const bool is_pitch = (turn == 0) == (k % 2 == 0);
        const std::size_t i = 2 * m + (is_pitch ? 0 : 1);
        const Vec3 axis = is_pitch ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
        chain.hinges.push_back({at.position_m, rotate(at.quaternion, axis), i});
        at.quaternion = multiply(at.quaternion, quaternion_of(scale(axis, theta[i])));
      }
      at = compose(at, {{robot.segment[m].module_length_m, 0, 0}, {1, 0, 0, 0}});
    }
    chain.nodes.push_back(at);
  }
  return chain;
}

// The full Jacobian (one column per hinge) with the columns of each theta added up (eq. 3-12 of the source).
Jacobian summed_jacobian(const Chain& chain) {
  Jacobian J;
  for (const Hinge& hinge : chain.hinges) {
    const Vec3 lever = subtract(chain.nodes.back().position_m, hinge.point_m);
    J.linear[hinge.theta] = add(J.linear[hinge.theta], cross(hinge.axis, lever));
    J.angular[hinge.theta] = add(J.angular[hinge.theta], hinge.axis);
  }
  return J;
}

double jacobian_difference(const Jacobian& a, const Jacobian& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < kMaxTheta; ++k) {
    largest = std::max(
        {largest, largest_difference(a.linear[k], b.linear[k]), largest_difference(a.angular[k], b.angular[k])});
  }
  return largest;
}

// Central differences with a step h; the error is h^2 and rounding / h.
Jacobian difference_jacobian(const RobotParams& robot, const ThetaVector& theta, double h) {
  Jacobian J;
  for (std::size_t k = 0; k < static_cast<std::size_t>(robot.theta_count()); ++k) {
    ThetaVector more = theta, less = theta;
    more[k] += h, less[k] -= h;
    const Pose a = forward_kinematics(robot, less).tip_in_base, b = forward_kinematics(robot, more).tip_in_base;
    J.linear[k] = scale(subtract(b.position_m, a.position_m), 0.5 / h);
    J.angular[k] = scale(rotation_vector(multiply(b.quaternion, conjugate(a.quaternion))), 0.5 / h);
  }
  return J;
}

// req:A35 req:A36 req:A51
TEST(Kinematics, GoldenTipSegmentEndsAndJacobianAreMetTo1e9) {
  const RobotParams robot = zhu2022::table();
  ASSERT_GE(golden().at("cases").size(), 13u);
  for (const Json& entry : golden().at("cases")) {
    const ArmKinematics arm = forward_kinematics(robot, golden_theta(entry));
    EXPECT_LE(matrix_difference(arm.tip_in_base, entry.at("tip_pose").get<Matrix4>()), 1e-9) << entry.at("name");
    const auto ends = entry.at("segment_ends_m").get<std::vector<Vec3>>();
    for (std::size_t m = 0; m < 5; ++m)
      EXPECT_LE(largest_difference(arm.node_in_base[m + 1].position_m, ends[m]), 1e-9);
    const auto rows = entry.at("jacobian").get<std::vector<std::vector<double>>>();
    for (std::size_t r = 0; r < 6; ++r) {
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
        const auto& column = r < 3 ? arm.tip_jacobian.linear[k] : arm.tip_jacobian.angular[k];
        EXPECT_NEAR(column[r % 3], rows[r][k], 1e-9) << entry.at("name");
      }
    }
  }
}

// req:A11
TEST(Kinematics, GoldenCableLengthsAreMetTo1e9) {
  const RobotParams robot = zhu2022::table();
  const CableLayout layout = cable_layout(robot);
  for (const Json& entry : golden().at("cases")) {
    const CableGeometry geometry = cable_geometry(robot, layout, arm_trig(robot, golden_theta(entry)));
    const auto length = entry.at("cable_length_m").get<std::array<double, 15>>();
    const auto change = entry.at("cable_length_change_m").get<std::array<double, 15>>();
    for (std::size_t c = 0; c < 15; ++c) {
      EXPECT_NEAR(geometry.length_m[c], length[c], 1e-9) << entry.at("name") << " " << c;
      EXPECT_NEAR(geometry.length_m[c] - layout.zero_length_m[c], change[c], 1e-9) << entry.at("name") << " " << c;
    }
  }
}

// The rows (0,-90,odd) (l,0,even) (0,90,even) (l,0,odd), four times per segment.
// req:A3 req:A34 req:A35
TEST(Kinematics, ClosedFormEqualsTheSourcesSixteenRowsPerSegment) {
  const RobotParams robot = zhu2022::table();
  Random random(1);
  for (std::int32_t i = 0; i < 200; ++i) {
    const ThetaVector theta = random.theta(robot, 20.0);
    Matrix4 tip = dh_row(0, 0, 0);
    for (std::size_t m = 0; m < 5; ++m) {
      const double odd = theta[2 * m], even = theta[2 * m + 1];
      for (std::int32_t group = 0; group < 4; ++group) {
        tip = product(product(tip, dh_row(0, -kPi / 2, odd)), dh_row(0.1, 0, even));
        tip = product(product(tip, dh_row(0, kPi / 2, even)), dh_row(0.1, 0, odd));
      }
    }
    ASSERT_LE(matrix_difference(forward_kinematics(robot, theta).tip_in_base, tip), 1e-12);
  }
}

// Odd numbers of modules too: the closed form ends with half a pair more.
TEST(Kinematics, ClosedFormEqualsTheChainOfModulesForOtherArms) {
  Random random(2);
  for (const std::int32_t modules : {1, 2, 3, 7, 8, 9, 15, 16}) {
    RobotParams robot = zhu2022::uneven_table();
    robot.segment[1].modules = modules;
    for (std::int32_t i = 0; i < 50; ++i) {
      const ThetaVector theta = random.theta(robot, 20.0);
      const ArmKinematics arm = forward_kinematics(robot, theta);
      const Chain chain = chain_of(robot, theta);
      for (std::size_t m = 0; m < chain.nodes.size(); ++m) {
        ASSERT_LE(norm(subtract(arm.node_in_base[m].position_m, chain.nodes[m].position_m)), 1e-12) << modules;
        const Quat turn = multiply(arm.node_in_base[m].quaternion, conjugate(chain.nodes[m].quaternion));
        ASSERT_LE(norm(rotation_vector(turn)), 1e-12) << modules;
      }
      ASSERT_LE(jacobian_difference(arm.tip_jacobian, summed_jacobian(chain)), 1e-11) << modules;
    }
  }
}

// J6x10 = J6x80 S.
// req:A4 req:A36
TEST(Kinematics, ReducedJacobianEqualsTheEightyJointJacobianSummed) {
  const RobotParams robot = zhu2022::table();
  Random random(3);
  for (std::int32_t i = 0; i < 500; ++i) {
    const ThetaVector theta = random.theta(robot, i < 400 ? 20.0 : 1e-6);
    const Chain chain = chain_of(robot, theta);
    ASSERT_EQ(chain.hinges.size(), 80u);
    ASSERT_LE(jacobian_difference(forward_kinematics(robot, theta).tip_jacobian, summed_jacobian(chain)), 2e-12);
  }
}

// Also where the straight arm makes closed forms divide by zero.
// req:A36
TEST(Kinematics, ReducedJacobianEqualsFiniteDifferences) {
  for (const RobotParams& robot : {zhu2022::table(), zhu2022::uneven_table()}) {
    Random random(4);
    for (std::int32_t i = 0; i < 60; ++i) {
      const ThetaVector theta = i == 0 ? ThetaVector{} : random.theta(robot, i < 10 ? 1e-8 / kDegree : 20.0);
      const Jacobian J = forward_kinematics(robot, theta).tip_jacobian;
      ASSERT_LE(jacobian_difference(J, difference_jacobian(robot, theta, 1e-5)), 2e-7) << i;
    }
  }
}

TEST(Kinematics, NodeColumnsAreTheNodesOwnDerivatives) {
  const RobotParams robot = zhu2022::uneven_table();
  Random random(5);
  constexpr double kStep = 1e-5;
  for (std::int32_t i = 0; i < 20; ++i) {
    const ThetaVector theta = random.theta(robot, 20.0);
    const ArmKinematics arm = forward_kinematics(robot, theta);
    for (std::int32_t k = 0; k < robot.theta_count(); ++k) {
      ThetaVector more = theta, less = theta;
      more[static_cast<std::size_t>(k)] += kStep, less[static_cast<std::size_t>(k)] -= kStep;
      const ArmKinematics a = forward_kinematics(robot, less), b = forward_kinematics(robot, more);
      for (std::int32_t node = 1; node <= robot.segment_count; ++node) {
        const auto n = static_cast<std::size_t>(node);
        const Vec3 slope = scale(subtract(b.node_in_base[n].position_m, a.node_in_base[n].position_m), 0.5 / kStep);
        ASSERT_LE(largest_difference(node_jacobian_column(arm, node, k), slope), 2e-7);
      }
    }
  }
}

TEST(Kinematics, LinkPointsAreTheModulesOfTheChain) {
  const RobotParams robot = zhu2022::uneven_table();
  Random random(6);
  const ThetaVector theta = random.theta(robot, 20.0);
  const LinkPoints links = link_points(robot, theta);
  const Chain chain = chain_of(robot, theta);
  ASSERT_EQ(links.count, 1 + 7 + 8 + 9);
  for (std::size_t i = 0; i < 24; ++i)
    EXPECT_LE(largest_difference(links.point_in_base[i], chain.hinges[2 * i].point_m), 1e-13) << i;
  EXPECT_LE(largest_difference(links.point_in_base[24], chain.nodes.back().position_m), 1e-13);
}

}  // namespace
}  // namespace liana::cable
