#include "host/control/verification/judge_serial.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/control/verification/judge.hpp"
#include "host/model/clearance/free_part.hpp"
#include "host/model/simulation/straight_way.hpp"

namespace liana::verification {

namespace {

using Index = std::size_t;

constexpr double kMeanRate = 1.01;   // rates of rows are means over an interval of what the twin did in ticks
constexpr double kCatchingUp = 1.5;  // times the tip's limit
constexpr double kWayInterval_s = 0.02;
constexpr double kMaxWayRows = 20'000.0;
constexpr double kMaxMargin = 1e3;  // [deg, deg/s] before anything was looked at

// Angles and rates that the drives are told.
void judge_told(const serial::RobotParams& table, const simulation::ToldRows<serial::JointVector>& told, Judge& judge,
                SimulationVerdict& verdict) {
  double& angle_deg = verdict.margins.joint_deg = kMaxMargin;
  double& rate_deg_s = verdict.margins.rate_deg_s = kMaxMargin;
  for (Index row = 0; row < told.rows_rad.size(); ++row) {
    for (Index i = 0; i < table.joints(); ++i) {
      const serial::JointParams& joint = table.joint[i];
      const double now_rad = told.rows_rad[row][i], before_rad = told.rows_rad[row > 0 ? row - 1 : 0][i];
      const double middle_rad = 0.5 * (joint.low_rad + joint.high_rad);
      const double room_rad = 0.5 * (joint.high_rad - joint.low_rad);
      const double rate_rad_s = (now_rad - before_rad) / told.interval_s;
      judge.check(Refusal::kJointAngle, "angle from the middle of the range of joint", kDegrees, static_cast<int>(i),
                  now_rad - middle_rad, room_rad);
      judge.check(Refusal::kJointRate, "rate of joint", kDegreesPerSecond, static_cast<int>(i), rate_rad_s,
                  kMeanRate * joint.rate_rad_s);
      angle_deg = std::fmin(angle_deg, (room_rad - std::fabs(now_rad - middle_rad)) / kDegree);
      rate_deg_s = std::fmin(rate_deg_s, (joint.rate_rad_s - std::fabs(rate_rad_s)) / kDegree);
      if (verdict.passed()) continue;
      verdict.first = {"joint " + std::to_string(i + 1), static_cast<double>(row) * told.interval_s};
      return;
    }
  }
}

void judge_tip(const serial::RobotParams& table, const simulation::SerialMotion& motion, double interval_s,
               Judge& judge, SimulationVerdict& verdict) {
  const std::vector<Vec3>& tip_m = motion.tip_in_base_m;
  for (Index row = 1; row < tip_m.size() && verdict.passed(); ++row) {
    judge.check(Refusal::kTipSpeed, "simulated tip speed", kMetresPerSecond, -1,
                norm(subtract(tip_m[row], tip_m[row - 1])) / interval_s, kCatchingUp * table.tip.speed_m_s);
    if (!verdict.passed()) verdict.first = {"tip", static_cast<double>(row) * interval_s};
  }
}

// Where the arm goes, against scene and itself.
void judge_way(const simulation::SerialSimulation& simulation, const simulation::SerialMotion& motion,
               TooNear& too_near, SimulationVerdict& verdict) {
  const std::vector<Vec3>& tip_m = motion.tip_in_base_m;
  const double travel_m = tip_m.empty() ? 0.0 : norm(subtract(tip_m.back(), tip_m.front()));
  judge_distances(
      simulation.scene(), motion.distances, [&](std::int32_t link) { return simulation.contact().link_name(link); },
      travel_m, too_near, verdict);
}

// Of a piece at half of its joints' rates.
double duration_s(const serial::RobotParams& table, const serial::JointVector& from_rad,
                  const serial::JointVector& to_rad) {
  double long_s = kWayInterval_s;
  for (Index i = 0; i < table.joints(); ++i) {
    const double way_rad = std::fabs(to_rad[i] - from_rad[i]);
    long_s = std::max(
        {long_s, 2.0 * way_rad / table.joint[i].rate_rad_s, 2.1 * std::sqrt(way_rad / table.joint[i].accel_rad_s2)});
  }
  return long_s;
}

}  // namespace

void judge_serial(const serial::RobotParams& table, const simulation::SerialSimulation& simulation,
                  const simulation::ToldRows<serial::JointVector>& told, const simulation::SerialMotion& motion,
                  TooNear& too_near, SimulationVerdict& verdict) {
  judge_way(simulation, motion, too_near, verdict);
  if (!verdict.passed()) return;
  const First nearest = verdict.first;
  verdict.first = {};
  Judge judge(verdict);
  judge_told(table, told, judge, verdict);
  judge_tip(table, motion, told.interval_s, judge, verdict);
  judge.conclude();
  if (verdict.first.body.empty()) verdict.first = nearest;
}

std::string refusal_of_way(const serial::RobotParams& table, simulation::SerialSimulation& simulation,
                           const std::vector<serial::JointVector>& points_rad, bool carries) {
  TooNear too_near;
  for (Index k = 0; k + 1 < points_rad.size(); ++k) {
    const TooNear before = too_near;
    const auto refusal = [&](double share) {
      serial::JointVector end_rad = points_rad[k + 1];
      for (Index i = 0; i < end_rad.size(); ++i)
        end_rad[i] = points_rad[k][i] + share * (end_rad[i] - points_rad[k][i]);
      const double long_s = duration_s(table, points_rad[k], end_rad);
      const auto way = simulation::straight_way(table, points_rad[k], end_rad, long_s,
                                                std::max(kWayInterval_s, long_s / kMaxWayRows));
      SimulationVerdict verdict;
      too_near = before;
      judge_way(simulation, simulation.run(points_rad[k], way, carries), too_near, verdict);
      return verdict.passed() ? std::string() : verdict.text;
    };
    const clearance::FreePart part = clearance::free_part(refusal);
    if (part.refusal.empty()) continue;
    const std::string place =
        "after " + std::to_string(static_cast<int>(100.0 * part.share)) + " % of the straight way ";
    if (points_rad.size() == 2) return place + "in the joint angles " + part.refusal;
    return place + "between points " + std::to_string(k) + " and " + std::to_string(k + 1) + " " + part.refusal;
  }
  return "";
}

}  // namespace liana::verification
