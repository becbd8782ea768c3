#include "tests/host/control/verification/corpus.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "host/base/eigen/thetas.hpp"
#include "host/model/simulation/straight_way.hpp"
#include "tests/host/control/verification/corpus_parts.hpp"

namespace liana::verification::corpus {

using namespace cable;
using zhu2022::Random;

namespace {

// How long a way takes whose rate rises to `rate_rad_s` by the table's acceleration.
double duration_s(const RobotParams& table, double way_rad, double rate_rad_s) {
  return way_rad / rate_rad_s + rate_rad_s / table.limits.theta_accel_rad_s2;
}

double to_point_m(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 ab = subtract(b, a);
  const double share = std::clamp(dot(subtract(p, a), ab) / dot(ab, ab), 0.0, 1.0);
  return norm(subtract(add(a, scale(ab, share)), p));
}

// Distance of the arm's axis from a point.
double axis_m(const RobotParams& table, const ThetaVector& theta_rad, const Vec3& point) {
  const LinkPoints arm = link_points(table, theta_rad);
  double least = 1e9;
  for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(arm.count); ++k)
    least = std::min(least, to_point_m(arm.point_in_base[k], arm.point_in_base[k + 1], point));
  return least;
}

// The least of a way in 2,000 poses.
double least_m(const Command& command, const Vec3& point) {
  double least = 1e9;
  for (int i = 0; i <= 2000; ++i)
    least = std::min(least, axis_m(command.table, along(command.from_rad, command.to_rad, i / 2000.0), point));
  return least;
}

// Least distance of the axes of links that are `apart` or more apart, each by 21 points; at one pose.
double least_of_itself_m(const RobotParams& table, const ThetaVector& theta_rad, std::size_t apart) {
  const LinkPoints arm = link_points(table, theta_rad);
  double least = 1e9;
  for (std::size_t a = 0; a + 1 < static_cast<std::size_t>(arm.count); ++a) {
    for (int i = 0; i <= 20; ++i) {
      const Vec3 p =
          add(arm.point_in_base[a], scale(subtract(arm.point_in_base[a + 1], arm.point_in_base[a]), i / 20.0));
      for (std::size_t b = a + apart; b + 1 < static_cast<std::size_t>(arm.count); ++b)
        least = std::min(least, to_point_m(arm.point_in_base[b], arm.point_in_base[b + 1], p));
    }
  }
  return least;
}

std::vector<Command> joint_angles(std::uint64_t seed) {
  std::vector<Command> out;
  Random random(100 * seed + 11);
  for (std::size_t i = 0; i < 2 * kThetas; ++i) {
    const std::size_t k = i / 2;
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    ThetaVector from_rad = random.theta(zhu2022::table(), 1.0);
    from_rad[k] = sign * 19.5 * kDegree;
    both_sides(out, [&](bool outside) {
      const double end_rad = sign * (outside ? 20.01 : 19.99) * kDegree;
      return Command{named("angle", i, outside),
                     patient(),
                     0.03,
                     {},
                     from_rad,
                     turned(from_rad, k, end_rad - from_rad[k]),
                     10.0,
                     outside ? Refusal::kJointAngle : Refusal::kNone};
    });
  }
  return out;
}

std::vector<Command> joint_rates(std::uint64_t seed) {
  std::vector<Command> out;
  Random random(100 * seed + 12);
  for (std::size_t i = 0; i < 2 * kThetas; ++i) {
    const std::size_t k = i / 2;
    const ThetaVector from_rad = random.theta(zhu2022::table(), 3.0);
    both_sides(out, [&](bool outside) {
      RobotParams table = patient();
      table.limits.theta_rate_rad_s = 0.2 * kDegree;
      const double rate_rad_s = (outside ? 1.02 : 0.99) * table.limits.theta_rate_rad_s;
      const double way_rad = (i % 2 == 0 ? 1.5 : -1.5) * kDegree;
      return Command{named("rate", i, outside),
                     table,
                     0.03,
                     {},
                     from_rad,
                     turned(from_rad, k, way_rad),
                     duration_s(table, std::fabs(way_rad), rate_rad_s),
                     outside ? Refusal::kJointRate : Refusal::kNone};
    });
  }
  return out;
}

// One angle turns, the tip goes by the column of its Jacobian.
std::vector<Command> tip_speeds(std::uint64_t seed) {
  std::vector<Command> out;
  Random random(100 * seed + 13);
  for (std::size_t i = 0; i < 2 * kThetas; ++i) {
    const std::size_t k = i / 2;
    const ThetaVector from_rad = random.theta(zhu2022::table(), 5.0);
    RobotParams table = patient();
    table.limits.tip_speed_m_s = 0.03;
    const double lever_m = norm(forward_kinematics(table, from_rad).tip_jacobian.linear[k]);
    if (lever_m < 0.5) continue;  // the way would be too long for one lever
    both_sides(out, [&](bool outside) {
      const double rate_rad_s = (outside ? 1.10 : 1.0) * table.limits.tip_speed_m_s / lever_m;
      const double way_rad = (i % 2 == 0 ? 2.0 : -2.0) * rate_rad_s;
      table.limits.theta_accel_rad_s2 = rate_rad_s;  // within a second
      return Command{named("tip speed", i, outside),
                     table,
                     0.03,
                     {},
                     from_rad,
                     turned(from_rad, k, way_rad),
                     duration_s(table, std::fabs(way_rad), rate_rad_s),
                     outside ? Refusal::kTipSpeed : Refusal::kNone};
    });
  }
  return out;
}

// The tip stands and the body goes: a direction that its Jacobian does not see.
std::vector<Command> node_speeds(std::uint64_t seed) {
  std::vector<Command> out;
  Random random(100 * seed + 14);
  for (std::size_t i = 0; i < 10; ++i) {
    const ThetaVector from_rad = random.theta(zhu2022::table(), 8.0);
    RobotParams table = patient();
    table.limits.tip_speed_m_s = 0.001;
    const ArmKinematics arm = forward_kinematics(table, from_rad);
    Eigen::Matrix<double, 6, 10> jacobian;
    jacobian.topRows<3>() = eigen::view(arm.tip_jacobian.linear, 10);
    jacobian.bottomRows<3>() = eigen::view(arm.tip_jacobian.angular, 10);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeFullV);
    const Eigen::VectorXd way = svd.matrixV().col(9);
    double fastest_m = 0.0;
    for (std::int32_t node = 1; node < 5; ++node) {
      Vec3 sum{};
      for (std::int32_t k = 0; k < 10; ++k) sum = add(sum, scale(node_jacobian_column(arm, node, k), way[k]));
      fastest_m = std::max(fastest_m, norm(sum));
    }
    both_sides(out, [&](bool outside) {
      const double share_1_s = (outside ? 1.08 : 0.92) * kNodeShare * table.limits.tip_speed_m_s / fastest_m;
      ThetaVector to_rad = from_rad;
      for (std::size_t k = 0; k < 10; ++k) to_rad[k] += 20.0 * share_1_s * way[static_cast<Eigen::Index>(k)];
      const double rate_rad_s = share_1_s * way.cwiseAbs().maxCoeff();
      table.limits.theta_accel_rad_s2 = 0.1 * rate_rad_s;  // within ten seconds: it hardly swings
      return Command{named("node speed", i, outside),
                     table,
                     0.03,
                     {},
                     from_rad,
                     to_rad,
                     duration_s(table, 20.0 * rate_rad_s, rate_rad_s),
                     outside ? Refusal::kNodeSpeed : Refusal::kNone};
    });
  }
  return out;
}

// A ball beside the way, as near as may just be claimed to be free, and a little nearer.
std::vector<Command> spheres(std::uint64_t seed) {
  std::vector<Command> out;
  Random random(100 * seed + 15);
  for (std::size_t i = 0; i < 40; ++i) {
    const ThetaVector from_rad = random.theta(zhu2022::table(), 6.0);
    ThetaVector to_rad = from_rad;
    const ThetaVector change_rad = random.theta(zhu2022::table(), 0.6);
    for (std::size_t k = 0; k < kThetas; ++k) to_rad[k] += change_rad[k];
    Command command{"", patient(), 0.03, {}, from_rad, to_rad, 100.0, Refusal::kNone};
    command.table.limits.theta_accel_rad_s2 = 0.002 * kDegree;  // nothing swings beyond what angles say
    const LinkPoints arm = link_points(command.table, to_rad);
    const auto link = static_cast<std::size_t>(random.uniform(8.0, 40.0));
    const Vec3 beside = add(arm.point_in_base[link], random.vector(0.3));
    // Towards the ball, that is: who leaves it may go.
    if (axis_m(command.table, from_rad, beside) < axis_m(command.table, to_rad, beside))
      std::swap(command.from_rad, command.to_rad);
    const double least = least_m(command, beside);
    if (least < 0.06) continue;  // no ball fits there
    // Less would be an arm that stands too near from the beginning: such a one may go along the ball (TooNear).
    if (axis_m(command.table, command.from_rad, beside) < least + 0.002) continue;
    both_sides(out, [&](bool outside) {
      const double left_m = outside ? -0.001 : 0.001;
      const double radius_m = least - command.link_radius_m - command.scene.margins.prediction_m - left_m;
      Command one = command;
      one.name = named("ball", i, outside);
      one.scene.spheres.push_back({"ball", beside, radius_m});
      one.expected = outside ? Refusal::kSceneContact : Refusal::kNone;
      return one;
    });
  }
  return out;
}

// An arm of thin wire through a foil: between any two poses it is on one side or on the other.
std::vector<Command> thin_plates(std::uint64_t seed) {
  std::vector<Command> out;
  Random random(100 * seed + 16);
  for (std::size_t i = 0; i < 30; ++i) {
    const ThetaVector from_rad = random.theta(zhu2022::table(), 5.0);
    RobotParams table = patient();
    table.limits.theta_accel_rad_s2 = kDegree;
    const std::size_t k = 8 + i % 2;
    Command command{named("foil", i, true), table, 1e-5, {}, from_rad, turned(from_rad, k, 0.5 * kDegree), 1.5,
                    Refusal::kSceneContact};
    command.scene.margins.prediction_m = 0.0;
    const Vec3 before = forward_kinematics(table, from_rad).tip_in_base.position_m;
    const Vec3 after = forward_kinematics(table, command.to_rad).tip_in_base.position_m;
    const Vec3 way = subtract(after, before);
    const Vec3 n = scale(way, 1.0 / norm(way));
    const Vec3 helper = std::fabs(n[0]) < 0.6 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
    const Vec3 across = cross(n, helper);
    const Vec3 u = scale(across, 1.0 / norm(across));
    // As small as two centimetres, so that the rest of the arm passes by.
    command.scene.boxes.push_back(
        {"foil", add(before, scale(way, random.uniform(0.3, 0.7))), {1e-5, 0.02, 0.02}, {n, u, cross(n, u)}});
    out.push_back(command);
  }
  return out;
}

// The balls again: an arm that stands nearer to one than it may is let go, and not let nearer.
std::vector<Command> ways_out(std::uint64_t seed) {
  std::vector<Command> out;
  for (Command command : spheres(seed)) {
    if (command.expected == Refusal::kNone) continue;
    command.name += ", turned round";
    std::swap(command.from_rad, command.to_rad);
    const config::SceneSphere& ball = command.scene.spheres[0];
    const double begin_m = axis_m(command.table, command.from_rad, ball.center_m);
    if (least_m(command, ball.center_m) < begin_m - 1e-5) continue;  // not all the way away
    command.expected = Refusal::kNone;
    out.push_back(command);
  }
  return out;
}

// Bent on until it touches itself; where it would is found by halving.
std::vector<Command> self_contacts(std::uint64_t seed) {
  std::vector<Command> out;
  Random random(100 * seed + 17);
  const RobotParams table = patient();
  for (std::size_t i = 0; out.size() < 40 && i < 200; ++i) {
    ThetaVector open_rad{}, closed_rad{};
    for (std::size_t k = 0; k < kThetas; ++k) closed_rad[k] = random.uniform(-19.0, 19.0) * kDegree;
    double low = 0.0, high = 0.0;
    const auto touches = [&](double share) {
      return least_of_itself_m(table, along(open_rad, closed_rad, share), 6) < 2 * 0.03;
    };
    for (double share = 0.02; share <= 1.0 && high == 0.0; share += 0.02) {
      if (touches(share)) high = share, low = share - 0.02;
    }
    if (high == 0.0) continue;
    for (int half = 0; half < 12; ++half) (touches(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
    both_sides(out, [&](bool outside) {
      const ThetaVector from_rad = along(open_rad, closed_rad, low - 0.02);
      const ThetaVector to_rad = along(open_rad, closed_rad, outside ? high + 0.003 : low - 0.003);
      return Command{named("itself", i, outside),
                     table,
                     0.03,
                     {},
                     from_rad,
                     to_rad,
                     60.0,
                     outside ? Refusal::kSelfContact : Refusal::kNone};
    });
  }
  return out;
}

// A jolt at the root, and the same way in good time.
std::vector<Command> swings(std::uint64_t seed) {
  std::vector<Command> out;
  Random random(100 * seed + 18);
  for (std::size_t i = 0; i < 12; ++i) {
    const ThetaVector from_rad = random.theta(zhu2022::table(), 4.0);
    both_sides(out, [&](bool outside) {
      return Command{named("jolt", i, outside),
                     patient(),
                     0.03,
                     {},
                     from_rad,
                     turned(from_rad, i % 4, (i < 6 ? 0.2 : -0.2) * kDegree),
                     outside ? 0.1 : 20.0,
                     outside ? Refusal::kSwingTension : Refusal::kNone};
    });
  }
  return out;
}

std::vector<Command> free_motions(std::uint64_t seed) {
  std::vector<Command> out;
  Random random(100 * seed + 19);
  for (std::size_t i = 0; i < 60; ++i) {
    const ThetaVector from_rad = random.theta(zhu2022::table(), 6.0);
    ThetaVector to_rad = from_rad;
    const ThetaVector change_rad = random.theta(zhu2022::table(), 0.5);
    for (std::size_t k = 0; k < kThetas; ++k) to_rad[k] += change_rad[k];
    out.push_back({named("free", i, false), zhu2022::table(), 0.03, {}, from_rad, to_rad, 60.0, Refusal::kNone});
  }
  return out;
}

}  // namespace

const std::array<Class, 12> kClasses{{{"JointAngle", joint_angles, 40},
                                      {"JointRate", joint_rates, 40},
                                      {"TipSpeed", tip_speeds, 30},
                                      {"NodeSpeed", node_speeds, 20},
                                      {"Ball", spheres, 60},
                                      {"Box", boxes, 60},
                                      {"Convex", convex_bodies, 60},
                                      {"WayOut", ways_out, 15},
                                      {"ThinPlate", thin_plates, 30},
                                      {"Self", self_contacts, 30},
                                      {"Swing", swings, 24},
                                      {"Free", free_motions, 60}}};

SimulationVerdict verdict_of(const Command& command) {
  const double interval_s = command.table.interval_ticks * command.table.tick_s;
  const simulation::JointSequence way =
      simulation::straight_way(command.table, command.from_rad, command.to_rad, command.duration_s, interval_s);
  simulation::StartState start;
  start.theta_rad = command.from_rad;
  simulation::Simulation simulation({command.table, command.link_radius_m, 0.4, 0.2}, command.scene);
  const MotionRules rules{command.table, command.scene, {}, {}};
  TooNear too_near;
  return judge_simulated(rules, way, true, simulation.run(start, way), too_near);
}

}  // namespace liana::verification::corpus
