// What is pushed when in a self-test of the force estimate.
#include <algorithm>
#include <cmath>
#include <random>

#include "firmware_like/math/trig.hpp"
#include "host/apps/launcher/force_session.hpp"
#include "host/apps/launcher/force_times.hpp"
#include "host/base/json/json.hpp"

namespace liana::launcher {
namespace {

constexpr double kTurn_deg = 1.5;              // of every angle at most, about the configuration
constexpr double kMinBend = 0.7, kBend = 0.9;  // of a named pose: there is room to turn
constexpr double kBody_N = 3.0;
constexpr double kStraight_deg = 4.0;  // of every angle at most, where that pose is straight
constexpr const char* kPoses[] = {"prepare", "panel_edge", "jig", "zero"};

class Draw {
 public:
  Draw(std::uint64_t seed, std::size_t number) : engine_(1000 * seed + number) {}
  double within(double least, double most) {
    return least + (most - least) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
  }

 private:
  std::mt19937_64 engine_;
};

Vec3 direction(Draw& draw) {
  for (;;) {
    const Vec3 v{draw.within(-1.0, 1.0), draw.within(-1.0, 1.0), draw.within(-1.0, 1.0)};
    if (norm(v) > 0.1 && norm(v) <= 1.0) return scale(v, 1.0 / norm(v));
  }
}

// Something between the straight arm and the named pose.
std::vector<double> bent(const std::vector<double>& pose_deg, Draw& draw) {
  const bool is_straight = std::all_of(pose_deg.begin(), pose_deg.end(), [](double angle) { return angle == 0.0; });
  const double share = draw.within(kMinBend, kBend);
  std::vector<double> out;
  for (const double angle_deg : pose_deg)
    out.push_back(is_straight ? draw.within(-kStraight_deg, kStraight_deg) : share * angle_deg);
  return out;
}

std::string listed(const std::vector<double>& angles_deg) {
  std::string text;
  for (const double angle : angles_deg) text += (text.empty() ? "" : ",") + std::to_string(angle);
  return text;
}

std::vector<double> near(const std::vector<double>& pose_deg, const config::RobotConfig& robot, Draw& draw) {
  std::vector<double> goal = pose_deg;
  for (std::size_t i = 0; i < goal.size(); ++i) {
    const double max_deg = robot.table.segment[i / 2].theta_limit_rad / kDegree - 0.5;
    goal[i] = std::clamp(goal[i] + draw.within(-kTurn_deg, kTurn_deg), -max_deg, max_deg);
  }
  return goal;
}

std::int32_t link_in(const cable::RobotParams& table, std::int32_t segment, Draw& draw) {
  std::int32_t before = 0;
  for (std::int32_t j = 0; j < segment; ++j) before += table.segment[static_cast<std::size_t>(j)].modules;
  return before + static_cast<std::int32_t>(
                      std::ceil(draw.within(0.01, table.segment[static_cast<std::size_t>(segment)].modules)));
}

}  // namespace

ForcePlan force_plan(const config::RobotConfig& robot, std::size_t number, std::size_t pushes, std::uint64_t seed) {
  Draw draw(seed, number);
  ForcePlan plan{number, "", {}};
  std::vector<std::string> poses;
  for (const char* pose : kPoses)
    if (robot.named_poses_deg.contains(pose)) poses.emplace_back(pose);
  const std::string name = poses.empty() ? robot.named_poses_deg.begin()->first : poses[number % poses.size()];
  const std::vector<double> pose_deg = bent(robot.named_poses_deg.at(name), draw);
  plan.start_pose = listed(pose_deg);
  for (std::size_t i = 0; i < pushes; ++i) {
    const bool is_last = i + 1 == pushes;
    const double size_N = is_last ? (number % 2 == 0 ? 5.0 : kBody_N) : 1.0 + static_cast<double>((number / 2 + i) % 2);
    PlannedPush push{0, scale(direction(draw), size_N), near(pose_deg, robot, draw), near(pose_deg, robot, draw)};
    if (is_last && number % 2 == 1) {
      const auto later = static_cast<std::int32_t>(draw.within(0.0, robot.table.segment_count - 1.001));
      push.link = link_in(robot.table, 1 + later, draw);
    }
    plan.pushes.push_back(push);
  }
  return plan;
}

std::string push_list(const ForcePlan& plan, double tick_s) {
  const auto slots = [tick_s](double time_s) { return static_cast<std::int64_t>(std::llround(time_s / tick_s)); };
  Json list = Json::array();
  double begin_s = kFirstBlock_s;
  for (const PlannedPush& push : plan.pushes) {
    for (const PushTimes& times : {kAtRest, kOnTheMove})
      list.push_back({{"kind", "external_force"},
                      {"link", push.link},
                      {"x_N", push.force_N[0]},
                      {"y_N", push.force_N[1]},
                      {"z_N", push.force_N[2]},
                      {"slots", slots(kRise_s)},
                      {"at_slot", slots(begin_s + times.begin_s)},
                      {"for_slots", slots(times.end_s - times.begin_s)}});
    begin_s += kBlock_s;
  }
  return list.dump();
}

}  // namespace liana::launcher
