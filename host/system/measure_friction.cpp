// The motion of `liana calibrate --friction`.
#include <algorithm>
#include <vector>

#include "firmware_like/math/trig.hpp"
#include "host/calibration/friction_fit.hpp"
#include "host/json/json.hpp"
#include "host/system/calibrate_session.hpp"

namespace liana::system {
namespace {

using Degrees = std::vector<double>;

constexpr double kPatience_s = 60.0;  // of arm time, for one request

// One segment after the other, pitch and yaw together and against each other; each ends where it began.
std::vector<Degrees> goals_about(const Degrees& start_deg, const config::RobotConfig& robot) {
  std::vector<Degrees> goals;
  for (std::size_t j = 0; j < start_deg.size() / 2; ++j) {
    const double most_deg = robot.table.segment[j].theta_limit_rad / kDegree - 0.5;
    for (const auto& [pitch, yaw] : {std::pair{1, 1}, {-1, -1}, {1, -1}, {-1, 1}, {0, 0}}) {
      Degrees goal = start_deg;
      goal[2 * j] = std::clamp(start_deg[2 * j] + pitch * kFrictionTurn_deg, -most_deg, most_deg);
      goal[2 * j + 1] = std::clamp(start_deg[2 * j + 1] + yaw * kFrictionTurn_deg, -most_deg, most_deg);
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
  for (const Json& tension : state.at("tension_N")) tension_N[i++] = tension.get<double>();
  fit.add(commanded_rad, tension_N, !state.value("at_rest", true));
}

bool is_in(const Json& state, const char* wanted) { return state.value("state", "") == wanted; }

}  // namespace

// The state in which it is done; a request without "op" only waits.
Json CalibrateSession::ask_and_wait(const Json& request, const std::function<bool(const Json&)>& is_done,
                                    const std::function<void(const Json&)>& look) {
  bool asked = !request.contains("op");
  for (double since_s = -1.0;;) {
    const Json state = next_state();
    if (since_s < 0.0) since_s = state.value("time_s", 0.0);
    const Json faults = state.value("faults", Json::array());
    if (!faults.empty()) give_up("fault " + faults[0].value("name", "") + ": " + faults[0].value("text", ""));
    if (state.value("time_s", 0.0) - since_s > kPatience_s) give_up("the arm did not answer " + request.dump());
    look(state);
    // A state that was on its way when the request was sent says nothing of it.
    const bool done = asked && state.value("time_s", 0.0) - since_s > 0.1 && is_done(state);
    if (!asked) system_.send(request);
    asked = true;
    system_.send({{"op", "done"}, {"tick", state.at("tick")}});
    if (done) return state;
  }
}

calibration::Friction CalibrateSession::measure_friction(const config::RobotConfig& robot) {
  calibration::FrictionFit fit(robot.table);
  const auto ignore = [](const Json&) {};
  start();
  ask_and_wait(
      Json::object(), [](const Json& s) { return is_in(s, "DISABLED") && s.value("is_homed", false); }, ignore);
  ask_and_wait(
      {{"op", "acquire"}}, [](const Json& s) { return s.value("owner", "") == "liana calibrate"; }, ignore);
  const Json enabled = ask_and_wait(
      {{"op", "state_command"}, {"command", "enable"}}, [](const Json& s) { return is_in(s, "ENABLED"); }, ignore);
  for (const Degrees& goal : goals_about(enabled.at("setpoint_js_deg").get<Degrees>(), robot)) {
    ask_and_wait(
        {{"op", "move_jp"}, {"goal_deg", goal}, {"rate_deg_s", kFrictionRate_deg_s}},
        [](const Json& s) { return !s.value("is_busy", true); }, [&fit](const Json& s) { add(s, fit); });
  }
  ask_and_wait(
      {{"op", "state_command"}, {"command", "disable"}}, [](const Json& s) { return is_in(s, "DISABLED"); }, ignore);
  return fit.solve();
}

}  // namespace liana::system
