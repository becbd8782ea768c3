// The motion of `liana calibrate --friction`.
#include <algorithm>
#include <vector>

#include "firmware_like/math/trig.hpp"
#include "host/apps/launcher/calibrate_session.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/calibration/friction_fit.hpp"

namespace liana::launcher {
namespace {

using Degrees = std::vector<double>;

// One segment after the other, pitch and yaw together and against each other; each ends where it began.
std::vector<Degrees> goals_about(const Degrees& start_deg, const config::RobotConfig& robot) {
  std::vector<Degrees> goals;
  for (std::size_t j = 0; j < start_deg.size() / 2; ++j) {
    const double max_deg = robot.table.segment[j].theta_limit_rad / kDegree - 0.5;
    for (const auto& [pitch, yaw] : {std::pair{1, 1}, {-1, -1}, {1, -1}, {-1, 1}, {0, 0}}) {
      Degrees goal = start_deg;
      goal[2 * j] = std::clamp(start_deg[2 * j] + pitch * kFrictionTurn_deg, -max_deg, max_deg);
      goal[2 * j + 1] = std::clamp(start_deg[2 * j + 1] + yaw * kFrictionTurn_deg, -max_deg, max_deg);
      goals.push_back(goal);
    }
  }
  return goals;
}

void add(const Json& state, calibration::FrictionFit& fit) {
  cable::ThetaVector commanded_rad{};
  cable::CableVector tension_N{};
  std::size_t i = 0;
  for (const Json& angle : state.at("setpoint_js_deg")) commanded_rad[i++] = angle.get<double>() * kDegree;
  i = 0;
  for (const Json& tension : state.at("tension_N")) tension_N[i++] = tension.is_number() ? tension.get<double>() : 0.0;
  fit.add(commanded_rad, tension_N, !state.value("at_rest", true));
}

}  // namespace

calibration::Friction CalibrateSession::measure_friction(const config::RobotConfig& robot) {
  calibration::FrictionFit fit(robot.table);
  const Json enabled = session_.enable();
  for (const Degrees& goal : goals_about(enabled.at("setpoint_js_deg").get<Degrees>(), robot)) {
    session_.ask_and_wait(
        {{"op", "move_jp"}, {"goal_deg", goal}, {"rate_deg_s", kFrictionRate_deg_s}},
        [](const Json& s) { return !s.value("is_busy", true); }, [&fit](const Json& s) { add(s, fit); });
  }
  disable();
  return fit.solve();
}

}  // namespace liana::launcher
