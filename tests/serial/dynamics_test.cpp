// The core's dynamics against MuJoCo's, which has other methods and the bench's own reading of the same table.
#include "firmware_like/serial/dynamics.hpp"

#include <cmath>

#include "firmware_like/serial/kinematics.hpp"
#include "tests/serial/both_tables.hpp"
#include "tests/serial/mujoco_arm.hpp"

namespace liana::test {
namespace {

using serial::Dynamics;
using serial::JointMotion;
using serial::Wrench;

constexpr double kRelative = 1e-9;

config::SerialRobotConfig host_robot(const Json& table) { return config::parse_serial_robot(table.dump(), "r"); }

JointMotion random_motion(Numbers& numbers, std::size_t joints) {
  return {numbers.joints(joints, 4.7), numbers.joints(joints, 2.0), numbers.joints(joints, 2.0)};
}

// Largest difference of the two, as a share of the largest torque of the state.
double difference(const serial::JointVector& own, const std::vector<double>& other) {
  double most = 0.0, off = 0.0;
  for (std::size_t i = 0; i < other.size(); ++i) {
    most = std::max(most, std::fabs(other[i]));
    off = std::max(off, std::fabs(own[i] - other[i]));
  }
  return off / most;
}

struct Case {
  const char* name;
  Json table;
};

std::vector<Case> arms() {
  return {{"micro", config::good_table("robot", "micro")},
          {"macro", config::good_table("robot", "macro")},
          {"six odd joints", six_odd_joints()}};
}

TEST(SerialDynamics, TorquesOfAThousandRandomStatesAreMujocos) {
  for (const Case& arm : arms()) {
    const config::SerialRobotConfig robot = host_robot(arm.table);
    Numbers numbers(15);
    const serial::LinkMass payload = numbers.body(800.0);
    const Vec3 gravity = numbers.vector(9.81);
    Dynamics dynamics(robot.table, robot.masses);
    dynamics.set_payload(payload);
    MujocoArm mujoco(bench_robot(arm.table), payload, gravity);
    double worst = 0.0;
    for (int state = 0; state < 1000; ++state) {
      const JointMotion motion = random_motion(numbers, robot.table.joints());
      const Wrench wrench{numbers.vector(300.0), numbers.vector(100.0)};
      worst =
          std::max(worst, difference(dynamics.torque_Nm(motion, wrench, gravity), mujoco.torque_Nm(motion, wrench)));
    }
    EXPECT_LT(worst, kRelative) << arm.name;
    EXPECT_GT(worst, 0.0) << "two methods round otherwise";
  }
}

TEST(SerialDynamics, TheMassMatrixIsMujocosAndTheUnitMatrixBeyondTheLastJoint) {
  for (const Case& arm : arms()) {
    const config::SerialRobotConfig robot = host_robot(arm.table);
    const std::size_t joints = robot.table.joints();
    Numbers numbers(16);
    const serial::LinkMass payload = numbers.body(800.0);
    Dynamics dynamics(robot.table, robot.masses);
    dynamics.set_payload(payload);
    MujocoArm mujoco(bench_robot(arm.table), payload, {});
    for (int state = 0; state < 1000; ++state) {
      const JointMotion motion = random_motion(numbers, joints);
      mujoco.torque_Nm(motion, {});
      const std::vector<double> other = mujoco.mass_matrix();
      serial::MassMatrix own = dynamics.mass_matrix(motion.joint_rad);
      for (std::size_t r = 0; r < own.size(); ++r) {
        for (std::size_t c = 0; c < own.size(); ++c) {
          const bool inside = r < joints && c < joints;
          ASSERT_NEAR(own[r][c], inside ? other[r * joints + c] : (r == c ? 1.0 : 0.0), kRelative * other[0])
              << arm.name << ' ' << r << ' ' << c;
        }
      }
      ASSERT_TRUE(cholesky_factor(own));
    }
  }
}

// J^T F by the kinematics, which have their own golden values.
TEST(SerialDynamics, AWrenchAtRestTakesItsTransposedJacobian) {
  const config::SerialRobotConfig robot = host_robot(config::good_table("robot", "micro"));
  const Dynamics dynamics(robot.table, robot.masses);
  Numbers numbers(17);
  for (int state = 0; state < 200; ++state) {
    JointMotion rest;
    rest.joint_rad = numbers.joints(7, 4.7);
    const Wrench wrench{numbers.vector(50.0), numbers.vector(20.0)};
    const serial::JointVector torque = dynamics.torque_Nm(rest, wrench);
    const serial::Jacobian J = serial::forward_kinematics(robot.table, rest.joint_rad).tip_jacobian;
    for (std::size_t i = 0; i < 7; ++i)
      ASSERT_NEAR(torque[i], -dot(J.linear[i], wrench.force_N) - dot(J.angular[i], wrench.torque_Nm), 1e-10);
  }
}

TEST(SerialDynamics, APayloadReplacesTheOneBeforeAndNoneIsTheArmAlone) {
  const config::SerialRobotConfig robot = host_robot(config::good_table("robot", "micro"));
  Numbers numbers(18);
  const JointMotion motion = random_motion(numbers, 7);
  Dynamics dynamics(robot.table, robot.masses);
  const serial::JointVector alone = dynamics.torque_Nm(motion, {});
  dynamics.set_payload(numbers.body(500.0));
  EXPECT_GT(std::fabs(dynamics.torque_Nm(motion, {})[0] - alone[0]), 1.0);
  dynamics.set_payload(numbers.body(900.0));
  dynamics.set_payload({});
  EXPECT_EQ(dynamics.torque_Nm(motion, {}), alone);
}

// A body seen from another frame is the same body: as a payload in one frame or moved into it from the other.
TEST(SerialDynamics, AMovedBodyIsTheSameFromBothFrames) {
  Numbers numbers(19);
  for (int i = 0; i < 100; ++i) {
    const serial::LinkMass body = numbers.body(100.0), other = numbers.body(100.0);
    const Pose pose{numbers.vector(1.0), quaternion_of(numbers.vector(1.5))};
    const serial::LinkMass here = joined(moved(body, pose), moved(other, pose)),
                           there = moved(joined(body, other), pose);
    const serial::LinkMass back = moved(there, inverse(pose));
    for (std::size_t k = 0; k < serial::kInertiaElements; ++k) {
      EXPECT_NEAR(here.inertia_kgm2[k], there.inertia_kgm2[k], 1e-10);
      EXPECT_NEAR(back.inertia_kgm2[k], joined(body, other).inertia_kgm2[k], 1e-10);
    }
  }
}

// req:B1
TEST(SerialTables, TheSmallArmStandsOnTheTipOfTheLockedLargeOne) {
  const config::SerialRobotConfig pair = host_robot(config::good_table("robot", "macro_micro"));
  const config::SerialRobotConfig macro = host_robot(config::good_table("robot", "macro"));
  ASSERT_TRUE(pair.base);
  EXPECT_EQ(pair.base->name, "macro");
  EXPECT_EQ(pair.table.joint_count, 7);
  EXPECT_EQ(pair.base->stiffness_Nm_rad[6], 4264.0);
  const double reach_m = serial::chain_length_m(macro.table) + serial::chain_length_m(pair.table);
  EXPECT_GT(2.0 * reach_m, 25.0) << "from one side to the other of where the pair stands";
}

}  // namespace
}  // namespace liana::test
