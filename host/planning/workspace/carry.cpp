#include "host/planning/workspace/carry.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "firmware_like/cable/arm/feed_monitor.hpp"
#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/base/random/random.hpp"
#include "host/model/config/drive_names.hpp"
#include "host/model/config/theta_numbers.hpp"

namespace liana::workspace {

using namespace cable;
namespace {

using Index = std::size_t;
using Poses = std::vector<ThetaVector>;

constexpr double kStandardGravity_m_s2 = 9.80665;
constexpr double kPayloadStep_kg = 0.001;
constexpr std::uint64_t kCarryStream = 11;
constexpr Index kHardest = 8;  // poses that are made harder
constexpr int kSweeps = 3;
constexpr int kRounds = 8;

PoseTension tension_at(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad) {
  const TensionPlan plan = plan_at_rest(table, layout, theta_rad);
  const std::span<const double> tension_N = of_cables(table, plan.motor_N);
  const auto [least, most] = std::minmax_element(tension_N.begin(), tension_N.end());
  const auto index = [&](auto at) { return static_cast<Index>(&*at - plan.motor_N.data()); };
  PoseTension out{*most, *least, index(most), index(least), plan.balanced};
  if (table.feed_count() == 0) return out;
  const ArmTrig trig = arm_trig(table, theta_rad);
  const ThetaVector load_Nm = static_load_Nm(table, theta_rad, trig, forward_kinematics(table, trig));
  for (std::int32_t axis = 0; axis < table.feed_count(); ++axis) {
    const double force_N = std::fabs(feed_force_N(table, axis, load_Nm[static_cast<Index>(axis)]));
    if (force_N <= std::max(table.tension.hard_limit_N, out.max_N)) continue;
    out.max_N = force_N;
    out.max_cable = static_cast<Index>(axis);
  }
  return out;
}

// Above 1 over the ceiling, or below the floor.
double hardness(const TensionLimits& limits, const PoseTension& tension) {
  if (!tension.balanced) return 1e9;
  const double low = tension.min_N < limits.floor_motor_N ? 1.0 + limits.floor_motor_N - tension.min_N : 0.0;
  return std::max(tension.max_N / limits.ceiling_free_N, low);
}

Poses drawn(const RobotParams& table, std::int32_t samples, std::uint64_t seed) {
  simulated::RandomStream random(seed, kCarryStream);
  Poses out(1);  // the straight arm
  for (std::int32_t i = 1; i < samples; ++i) {
    const double factor = i % 2 == 1 ? 1.0 : random.uniform(0.0, 1.0);
    ThetaVector theta_rad{};
    for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k)
      theta_rad[k] = factor * table.segment[k / 2].theta_limit_rad * random.uniform(-1.0, 1.0);
    out.push_back(theta_rad);
  }
  return out;
}

// One angle after the other to that end of its range, or to 0, where the pose is hardest.
ThetaVector harder(const RobotParams& table, const CableLayout& layout, ThetaVector theta_rad) {
  double now = hardness(table.tension, tension_at(table, layout, theta_rad));
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
      const double limit_rad = table.segment[k / 2].theta_limit_rad;
      for (const double end_rad : {-limit_rad, 0.0, limit_rad}) {
        ThetaVector there_rad = theta_rad;
        there_rad[k] = end_rad;
        const double then = hardness(table.tension, tension_at(table, layout, there_rad));
        if (then > now) now = then, theta_rad = there_rad;
      }
    }
  }
  return theta_rad;
}

using Order = std::vector<std::pair<double, Index>>;  // hardness, below zero, and which pose

void add_harder(const RobotParams& table, const CableLayout& layout, Order& order, Poses& poses) {
  std::sort(order.begin(), order.end());
  for (Index i = 0; i < std::min(kHardest, order.size()); ++i)
    poses.push_back(harder(table, layout, poses[order[i].second]));
}

RobotParams with_payload(const RobotParams& table, double mass_kg) {
  RobotParams out = table;
  out.tool = cable::joined(table.tool, {mass_kg, {}});
  return out;
}

Payload payload_of(const RobotParams& table, const CableLayout& layout, const Poses& poses) {
  const TensionLimits& limits = table.tension;
  const auto is_held = [&](double mass_kg, const ThetaVector& theta_rad) {
    return hardness(limits, tension_at(with_payload(table, mass_kg), layout, theta_rad)) <= 1.0;
  };
  Payload out;
  out.mass_kg = kMaxPayload_kg;
  for (const ThetaVector& theta_rad : poses) {
    if (is_held(out.mass_kg, theta_rad)) continue;
    out.theta_rad = theta_rad;
    if (!is_held(0.0, theta_rad)) {
      out.mass_kg = 0.0, out.unloaded = false;
      break;
    }
    double held_kg = 0.0;
    while (out.mass_kg - held_kg > kPayloadStep_kg) {
      const double middle_kg = 0.5 * (held_kg + out.mass_kg);
      (is_held(middle_kg, theta_rad) ? held_kg : out.mass_kg) = middle_kg;
    }
    out.mass_kg = held_kg;
  }
  const double over_kg = out.unloaded ? out.mass_kg + kPayloadStep_kg : 0.0;
  const PoseTension there = tension_at(with_payload(table, over_kg), layout, out.theta_rad);
  const bool is_slack = there.min_N < limits.floor_motor_N;
  out.cable = is_slack ? there.min_cable : there.max_cable;
  out.tension_N = is_slack ? there.min_N : there.max_N;
  return out;
}

// Which poses are hardest hangs on what the arm carries: those found are made harder with it, until it stays.
Payload payload_of_hardest(const RobotParams& table, const CableLayout& layout, Poses poses) {
  Payload out = payload_of(table, layout, poses);
  for (int round = 0; round < kRounds && out.unloaded; ++round) {
    const RobotParams loaded = with_payload(table, out.mass_kg + kPayloadStep_kg);
    Order order;
    for (Index i = 0; i < poses.size(); ++i)
      order.emplace_back(-hardness(table.tension, tension_at(loaded, layout, poses[i])), i);
    add_harder(loaded, layout, order, poses);
    const double before_kg = out.mass_kg;
    out = payload_of(table, layout, poses);
    if (before_kg - out.mass_kg <= kPayloadStep_kg) break;
  }
  return out;
}

}  // namespace

PoseTension tension_at(const config::RobotConfig& robot, const std::string& name) {
  return tension_at(robot.table, config::theta_rad(robot.named_poses_deg.at(name)));
}

std::string refusal_of_pose(const config::RobotConfig& robot, const std::string& name) {
  const TensionLimits& limits = robot.table.tension;
  const PoseTension planned = tension_at(robot, name);
  if (!planned.balanced)
    return "pose " + name + ": the cables of a segment cannot turn both of its angles: change cables.phase_deg";
  const bool is_low = planned.min_N < limits.floor_motor_N;
  if (!is_low && planned.max_N <= limits.ceiling_free_N) return {};
  char text[240];
  if (planned.max_cable < static_cast<Index>(robot.table.feed_count())) {
    std::snprintf(text, sizeof text,
                  ": the %s of the base holds %.0f N: allowed up to tension.hard_limit_N, %g N (5002): mount the arm "
                  "otherwise, let it or its carriage weigh less, or widen base.roll_radius_m for the roll",
                  config::DriveNames(robot.table).cable(planned.max_cable).c_str(), planned.max_N, limits.hard_limit_N);
    return "pose " + name + text;
  }
  std::snprintf(text, sizeof text,
                ": tensions of %.1f to %.1f N are planned (%s): allowed %g to %g N: choose another pose, ",
                planned.min_N, planned.max_N,
                config::DriveNames(robot.table).cable(is_low ? planned.min_cable : planned.max_cable).c_str(),
                limits.floor_motor_N, limits.ceiling_free_N);
  return "pose " + name + text +
         (is_low
              ? "or other places of the holes (cables.face_offset_m, hole_radius_m, phase_deg): a cable would be slack"
              : "let it carry less, or raise tension.ceiling_free_N");
}

PoseTension tension_at(const RobotParams& table, const ThetaVector& theta_rad) {
  return tension_at(table, cable_layout(table), theta_rad);
}

TensionBand band_of(const TensionLimits& limits, const PoseTension& tension) {
  if (!tension.balanced || tension.min_N < limits.floor_motor_N || tension.max_N > limits.hard_limit_N)
    return TensionBand::kBeyond;
  if (tension.max_N > limits.alarm_N) return TensionBand::kOverAlarm;
  return tension.max_N > limits.ceiling_free_N ? TensionBand::kOverCeiling : TensionBand::kFree;
}

std::vector<Mounting> mountings(const RobotParams& table) {
  const double own = norm(table.gravity_m_s2), g = own > 0.0 ? own : kStandardGravity_m_s2;
  std::vector<Mounting> out{{"as in the table", table.gravity_m_s2}};
  const std::vector<Mounting> six{{"base up, hanging", {g, 0.0, 0.0}}, {"base down, standing", {-g, 0.0, 0.0}},
                                  {"lying, z up", {0.0, 0.0, -g}},     {"lying, z down", {0.0, 0.0, g}},
                                  {"lying, y up", {0.0, -g, 0.0}},     {"lying, y down", {0.0, g, 0.0}}};
  out.insert(out.end(), six.begin(), six.end());
  return out;
}

Carried what_it_carries(const config::RobotConfig& robot, const Mounting& mounting, std::int32_t samples,
                        std::uint64_t seed) {
  RobotParams table = robot.table;
  table.gravity_m_s2 = mounting.gravity_m_s2;
  const CableLayout layout = cable_layout(table);
  Carried out;
  out.mounting = mounting;
  Poses named;
  for (const auto& [name, angles_deg] : robot.named_poses_deg) named.push_back(config::theta_rad(angles_deg));
  Poses all = drawn(table, samples, seed);
  Order order;
  for (Index i = 0; i < all.size(); ++i) {
    const PoseTension tension = tension_at(table, layout, all[i]);
    const TensionBand band = band_of(table.tension, tension);
    out.share[static_cast<Index>(band)] += 1.0 / static_cast<double>(all.size());
    out.poses.push_back({tip_pose(table, arm_trig(table, all[i])).position_m, band});
    order.emplace_back(-hardness(table.tension, tension), i);
  }
  add_harder(table, layout, order, all);
  all.insert(all.end(), named.begin(), named.end());
  double most = -1.0;
  for (const ThetaVector& theta_rad : all) {
    const PoseTension tension = tension_at(table, layout, theta_rad);
    if (tension.max_N <= most) continue;
    most = tension.max_N;
    out.worst = tension, out.worst_rad = theta_rad;
  }
  out.named = payload_of(table, layout, named);
  out.all = payload_of_hardest(table, layout, all);
  return out;
}

}  // namespace liana::workspace
