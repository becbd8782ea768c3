// Serial kinematics against the product of exponentials (tests/golden/make_micro.py) and against finite differences.
#include "firmware_like/serial/kinematics.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/firmware_like/micro_arm.hpp"

namespace liana::serial {
namespace {

using micro::Random;
using nlohmann::json;

const json& golden() {
  static const json data = json::parse(std::ifstream(LIANA_GOLDEN_DIR "/micro.json"));
  return data.at("cases");
}

ArmKinematics solve(const json& entry) {
  return forward_kinematics(micro::table(), micro::radians(entry.at("joint_deg").get<micro::Degrees>()));
}

Vec3 axis_of(const Quat& q, std::size_t column) {
  Vec3 unit{};
  unit[column] = 1.0;
  return rotate(q, unit);
}

TEST(SerialKinematics, TipAgreesWithTheProductOfExponentials) {
  ASSERT_GE(golden().size(), 50u);
  for (const json& entry : golden()) {
    const Pose tip = solve(entry).tip_in_base;
    const json& expected = entry.at("tip_pose");
    for (std::size_t r = 0; r < 3; ++r) {
      EXPECT_NEAR(tip.position_m[r], expected[r][3].get<double>(), 1e-9) << entry.at("name");
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(axis_of(tip.quaternion, k)[r], expected[r][k].get<double>(), 1e-9) << entry.at("name");
    }
  }
}

TEST(SerialKinematics, JacobianAgreesWithTheProductOfExponentials) {
  for (const json& entry : golden()) {
    const Jacobian J = solve(entry).tip_jacobian;
    const json& expected = entry.at("tip_jacobian");
    for (std::size_t i = 0; i < micro::kJoints; ++i) {
      for (std::size_t r = 0; r < 3; ++r) {
        EXPECT_NEAR(J.linear[i][r], expected[r][i].get<double>(), 1e-9) << entry.at("name") << " joint " << i;
        EXPECT_NEAR(J.angular[i][r], expected[r + 3][i].get<double>(), 1e-9) << entry.at("name") << " joint " << i;
      }
    }
  }
}

void expect_jacobian_is_the_derivative(const RobotParams& robot, const JointVector& joint) {
  constexpr double kStep_rad = 1e-6;
  const Jacobian J = forward_kinematics(robot, joint).tip_jacobian;
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    JointVector less = joint, more = joint;
    less[i] -= kStep_rad;
    more[i] += kStep_rad;
    const Pose a = forward_kinematics(robot, less).tip_in_base, b = forward_kinematics(robot, more).tip_in_base;
    const Vec3 turn = rotation_vector(multiply(b.quaternion, conjugate(a.quaternion)));
    for (std::size_t r = 0; r < 3; ++r) {
      ASSERT_NEAR(J.linear[i][r], (b.position_m[r] - a.position_m[r]) / (2.0 * kStep_rad), 1e-8);
      ASSERT_NEAR(J.angular[i][r], turn[r] / (2.0 * kStep_rad), 1e-8);
    }
  }
}

TEST(SerialKinematics, JacobianIsTheDerivativeOfTheTip) {
  Random random(1);
  for (const RobotParams& robot : {micro::table(), micro::six_joint_table()}) {
    for (std::int32_t i = 0; i < 500; ++i)
      expect_jacobian_is_the_derivative(robot, micro::random_joints(robot, random));
  }
}

TEST(SerialKinematics, TwistIsTheJacobianTimesTheRates) {
  const RobotParams robot = micro::table();
  Random random(2);
  const Jacobian J = forward_kinematics(robot, micro::random_joints(robot, random)).tip_jacobian;
  JointVector rate{};
  rate[2] = 0.5;
  rate[6] = -0.25;
  const Twist twist = tip_twist(robot, J, rate);
  for (std::size_t r = 0; r < 3; ++r) {
    EXPECT_DOUBLE_EQ(twist.linear_m_s[r], 0.5 * J.linear[2][r] - 0.25 * J.linear[6][r]);
    EXPECT_DOUBLE_EQ(twist.angular_rad_s[r], 0.5 * J.angular[2][r] - 0.25 * J.angular[6][r]);
  }
}

// The payload study found 4.93 m from the base flange to the tip.
// req:B1
TEST(SerialKinematics, NoTipIsFartherAwayThanTheChainIsLong) {
  const RobotParams robot = micro::table();
  Random random(3);
  double farthest_m = 0.0;
  for (std::int32_t i = 0; i < 20000; ++i) {
    farthest_m = std::max(farthest_m,
                          norm(forward_kinematics(robot, micro::random_joints(robot, random)).tip_in_base.position_m));
  }
  EXPECT_LE(farthest_m, 4.94);
  EXPECT_GE(farthest_m, 4.7);
  EXPECT_LE(farthest_m, chain_length_m(robot));
}

}  // namespace
}  // namespace liana::serial
