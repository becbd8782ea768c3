// Orocos KDL on the same arm: a chain of 80 joints from the D-H rows of the source, for KDL knows no coupled joints. It
// therefore solves an easier inverse problem than ours: its 80 angles are free, and the coupled arm cannot take them
// up.
#include <cmath>
#include <cstdio>
#include <exception>
#include <kdl/chain.hpp>
#include <kdl/chainfksolverpos_recursive.hpp>
#include <kdl/chainiksolverpos_lma.hpp>
#include <kdl/chainiksolverpos_nr_jl.hpp>
#include <kdl/chainiksolvervel_wdls.hpp>
#include <kdl/chainjnttojacsolver.hpp>

#include "tests/benchmarks/meter.hpp"
#include "tests/benchmarks/problems.hpp"

namespace liana::bench {
namespace {

constexpr unsigned kJoints = 80;
constexpr double kLambda = 0.01;                              // damping of the WDLS solver
constexpr std::array<std::size_t, 4> kTurnOfRow{0, 1, 1, 0};  // odd, even, even, odd: pitch, yaw, yaw, pitch

// (0,-90,odd) (l,0,even) (0,90,even) (l,0,odd), four times a segment.
KDL::Chain dh_chain(const cable::RobotParams& robot) {
  KDL::Chain chain;
  for (std::size_t m = 0; m < 5; ++m) {
    const double l = robot.segment[m].module_length_m;
    for (int group = 0; group < 4; ++group) {
      for (const auto& [a, alpha] : {std::pair{0.0, -kPi / 2}, {l, 0.0}, {0.0, kPi / 2}, {l, 0.0}}) {
        chain.addSegment(KDL::Segment(KDL::Joint(KDL::Joint::RotZ), KDL::Frame::DH(a, alpha, 0.0, 0.0)));
      }
    }
  }
  return chain;
}

std::size_t theta_of(unsigned joint) { return 2 * (joint / 16) + kTurnOfRow[joint % 4]; }

KDL::JntArray joints_of(const cable::ThetaVector& theta) {
  KDL::JntArray q(kJoints);
  for (unsigned i = 0; i < kJoints; ++i) q(i) = theta[theta_of(i)];
  return q;
}

KDL::Frame frame_of(const Pose& pose) {
  const Quat& q = pose.quaternion;
  const Vec3& p = pose.position_m;
  return {KDL::Rotation::Quaternion(q[1], q[2], q[3], q[0]), KDL::Vector(p[0], p[1], p[2])};
}

Pose pose_of(const KDL::Frame& frame) {
  Pose pose{{frame.p.x(), frame.p.y(), frame.p.z()}, {}};
  frame.M.GetQuaternion(pose.quaternion[1], pose.quaternion[2], pose.quaternion[3], pose.quaternion[0]);
  return pose;
}

KDL::JntArray all_joints(double angle_rad) {
  KDL::JntArray q(kJoints);
  for (unsigned i = 0; i < kJoints; ++i) q(i) = angle_rad;
  return q;
}

struct Solvers {
  explicit Solvers(const cable::RobotParams& robot) : chain(dh_chain(robot)) { wdls.setLambda(kLambda); }

  // Pose and Jacobian of the reduced angles: the columns of each theta summed.
  cable::ArmKinematics forward(const KDL::JntArray& q) {
    KDL::Frame frame;
    fk.JntToCart(q, frame);
    jac.JntToJac(q, jacobian);
    cable::ArmKinematics out;
    out.tip_in_base = pose_of(frame);
    for (unsigned i = 0; i < kJoints; ++i) {
      const std::size_t k = theta_of(i);
      for (unsigned r = 0; r < 3; ++r) {
        out.tip_jacobian.linear[k][r] += jacobian(r, i);
        out.tip_jacobian.angular[k][r] += jacobian(r + 3, i);
      }
    }
    return out;
  }
  double error(const Pose& goal, const KDL::JntArray& q) {
    KDL::Frame frame;
    fk.JntToCart(q, frame);
    return tip_difference(goal, pose_of(frame));
  }

  KDL::Chain chain;
  KDL::ChainFkSolverPos_recursive fk{chain};
  KDL::ChainJntToJacSolver jac{chain};
  KDL::ChainIkSolverPos_LMA lma{chain, Eigen::Matrix<double, 6, 1>::Ones(), kSolved};
  KDL::ChainIkSolverVel_wdls wdls{chain};
  KDL::ChainIkSolverPos_NR_JL newton{chain, all_joints(-kPi), all_joints(kPi), fk, wdls, 100, kSolved};
  KDL::Jacobian jacobian{kJoints};
};

void forward(Meter& meter, const cable::RobotParams& robot, Solvers& solvers) {
  const auto poses = random_poses(robot, kCalls);
  std::vector<KDL::JntArray> joints;
  for (const cable::ThetaVector& theta : poses) {
    joints.push_back(joints_of(theta));
    const cable::ArmKinematics ours = forward_kinematics(robot, theta), kdl = solvers.forward(joints.back());
    require_agreement("pose of KDL", tip_difference(ours.tip_in_base, kdl.tip_in_base));
    require_agreement("Jacobian of KDL", jacobian_difference(ours.tip_jacobian, kdl.tip_jacobian));
  }
  meter.each("fk_jacobian", "kdl", kCalls,
             [&](std::size_t i) { return solvers.forward(joints[i]).tip_in_base.position_m[0]; });
}

void near(Meter& meter, const cable::RobotParams& robot, Solvers& solvers) {
  const auto problems = near_problems(robot, kCalls);
  const KDL::JntArray from = joints_of(problems[0].from_rad);
  KDL::JntArray q(kJoints);
  std::vector<KDL::Frame> goals;
  for (const IkProblem& problem : problems) goals.push_back(frame_of(problem.tip_in_base));
  for (std::size_t i = 0; i < kSlowCalls; ++i) {
    solvers.lma.CartToJnt(from, goals[i], q);
    require_agreement("the near goal of KDL LMA", solvers.error(problems[i].tip_in_base, q), 10.0 * kSolved);
    solvers.newton.CartToJnt(from, goals[i], q);
    require_agreement("the near goal of KDL NR_JL", solvers.error(problems[i].tip_in_base, q), 10.0 * kSolved);
  }
  meter.note("ik_near", "kdl", "ChainIkSolverPos_LMA; 80 free joints, no limits");
  meter.note("ik_near", "kdl_nr_jl", "ChainIkSolverPos_NR_JL with WDLS 0.01; 80 free joints");
  meter.note("ik_step", "kdl", "ChainIkSolverVel_wdls, 80 free joints");
  meter.each("ik_near", "kdl", kCalls,
             [&](std::size_t i) { return static_cast<double>(solvers.lma.CartToJnt(from, goals[i], q)); });
  meter.each("ik_near", "kdl_nr_jl", kSlowCalls,
             [&](std::size_t i) { return static_cast<double>(solvers.newton.CartToJnt(from, goals[i], q)); });
  KDL::Frame start;
  solvers.fk.JntToCart(from, start);
  meter.each("ik_step", "kdl", kSlowCalls, [&](std::size_t i) {
    return static_cast<double>(solvers.wdls.CartToJnt(from, KDL::diff(start, goals[i]), q));
  });
}

bool within_limits(const cable::RobotParams& robot, const KDL::JntArray& q) {
  for (unsigned i = 0; i < kJoints; ++i) {
    if (std::fabs(q(i)) > robot.segment[i / 16].theta_limit_rad) return false;
  }
  return true;
}

void random_goals(Meter& meter, const cable::RobotParams& robot, Solvers& solvers) {
  const auto problems = random_problems(robot, kTargets);
  const KDL::JntArray from(kJoints);
  KDL::JntArray q(kJoints);
  if (!RUNNING_ON_VALGRIND) {
    std::size_t solved = 0, usable = 0;
    for (const IkProblem& problem : problems) {
      solvers.lma.CartToJnt(from, frame_of(problem.tip_in_base), q);
      if (!(solvers.error(problem.tip_in_base, q) < 10.0 * kSolved)) continue;
      ++solved;
      if (within_limits(robot, q)) ++usable;
    }
    meter.note("ik_random", "kdl",
               "LMA: " + std::to_string(solved) + " of " + std::to_string(kTargets) + " solved, " +
                   std::to_string(usable) + " of them with every joint within its limit; 80 free joints");
  }
  for (std::size_t i = 0; i < kSlowCalls; ++i) {
    const KDL::Frame goal = frame_of(problems[i].tip_in_base);
    meter.once("ik_random", "kdl", [&] { return static_cast<double>(solvers.lma.CartToJnt(from, goal, q)); });
  }
}

}  // namespace
}  // namespace liana::bench

int main() try {
  using namespace liana::bench;
  Meter meter;
  const liana::cable::RobotParams robot = liana::cable::zhu2022::table();
  Solvers solvers(robot);
  forward(meter, robot, solvers);
  near(meter, robot, solvers);
  random_goals(meter, robot, solvers);
  meter.print();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
