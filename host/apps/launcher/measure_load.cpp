// The motion of `liana calibrate --load`.
#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware_like/math/trig.hpp"
#include "host/apps/launcher/calibrate_session.hpp"
#include "host/base/json/json.hpp"

namespace liana::launcher {
namespace {

using Degrees = std::vector<double>;

constexpr int kSettle = 50;          // states at rest before readings count: 1 s of 20 ms
constexpr int kReadings = 50;        // states that are averaged
constexpr double kRateShare = 0.5;   // of the table's
constexpr double kLongest_s = 40.0;  // of one motion, where the table's rate allows that

Degrees degrees(const cable::ThetaVector& theta_rad, std::size_t count) {
  Degrees out;
  for (std::size_t k = 0; k < count; ++k) out.push_back(theta_rad[k] / kDegree);
  return out;
}

void add(const Json& state, calibration::LoadReading& sum) {
  std::size_t k = 0, c = 0;
  for (const Json& angle : state.at("measured_js_deg")) sum.theta_rad[k++] += angle.get<double>() * kDegree / kReadings;
  for (const Json& tension : state.at("tension_N"))
    sum.tension_N[c++] += (tension.is_number() ? tension.get<double>() : 0.0) / kReadings;
}

}  // namespace

void CalibrateSession::go_to(const std::vector<double>& goal_deg, const config::RobotConfig& robot) {
  const double limit_deg_s = robot.table.limits.theta_rate_rad_s / kDegree;
  double max_deg = 0.0;
  for (std::size_t k = 0; k < goal_deg.size(); ++k) max_deg = std::max(max_deg, std::fabs(goal_deg[k] - at_deg_[k]));
  const double rate_deg_s = std::min(limit_deg_s, std::max(kRateShare * limit_deg_s, max_deg / kLongest_s));
  session_.ask_and_wait({{"op", "move_jp"}, {"goal_deg", goal_deg}, {"rate_deg_s", rate_deg_s}},
                        [](const Json& s) { return !s.value("is_busy", true); });
  at_deg_ = goal_deg;
}

calibration::LoadReading CalibrateSession::read_at_rest() {
  calibration::LoadReading sum;
  int seen = 0;
  session_.ask_and_wait(
      Json::object(), [&](const Json&) { return seen >= kSettle + kReadings; },
      [&](const Json& state) {
        if (state.value("at_rest", false) && ++seen > kSettle && seen <= kSettle + kReadings) add(state, sum);
      });
  return sum;
}

calibration::LoadResult CalibrateSession::measure_load(const config::RobotConfig& robot,
                                                       const std::vector<calibration::LoadPose>& poses) {
  calibration::LoadFit fit(robot.table);
  const auto angles = static_cast<std::size_t>(robot.table.theta_count());
  at_deg_ = session_.enable().at("setpoint_js_deg").get<Degrees>();
  const Degrees start_deg = at_deg_;
  for (const calibration::LoadPose& pose : poses) {
    std::array<calibration::LoadReading, 2> sides;
    for (const int side : {0, 1}) {
      go_to(degrees(pose.beside_rad(side == 0 ? -1.0 : 1.0), angles), robot);
      go_to(degrees(pose.theta_rad, angles), robot);
      sides[static_cast<std::size_t>(side)] = read_at_rest();
    }
    fit.add(sides);
  }
  go_to(start_deg, robot);
  disable();
  return fit.solve();
}

}  // namespace liana::launcher
