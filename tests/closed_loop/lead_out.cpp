#include "lead_out.hpp"

#include <algorithm>
#include <cmath>

#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

constexpr double kPoints = 0.8;     // of the path in an interval, as a retract goes
constexpr double kRateShare = 0.2;  // of a joint's rate at most: the core allows a quarter
constexpr double kStop_s = 5.0, kReset_s = 0.5, kEnable_s = 65.0;

bool is_enabled(const ArmUnderControl& arm) { return arm.outputs().state == OperatingState::kEnabled; }

double largest_change(const cable::ThetaVector& a, const cable::ThetaVector& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::fabs(a[k] - b[k]));
  return most;
}

bool is_overpulled(const ArmUnderControl& arm) {
  const cable::CableVector& now_N = arm.outputs().tension_measured_N;
  return *std::max_element(now_N.begin(), now_N.end()) > arm.table().tension.ceiling_free_N;
}

}  // namespace

LeadOut break_and_lead_out(ArmUnderControl& arm, std::size_t cable, const Path& path) {
  LeadOut way;
  const double interval_s = arm.table().tick_s * arm.table().interval_ticks;
  arm.plant().loosen(cable, 1.0);
  arm.wait(kStop_s);
  arm.ask(Request::kRecover);
  arm.wait(kReset_s);
  arm.ask(Request::kEnable);
  for (; way.enable_s < kEnable_s && !is_enabled(arm); way.enable_s += interval_s) arm.wait(interval_s);
  arm.plant().take_load();
  cable::Setpoint setpoint;
  setpoint.kind = CommandKind::kRetract;
  setpoint.joint_rad = arm.outputs().theta_command_rad;
  const double step_rad = kRateShare * arm.table().limits.theta_rate_rad_s * interval_s;
  double place = static_cast<double>(path.size() - 1);
  while (place > 0.0 && is_enabled(arm) && !is_overpulled(arm)) {
    const cable::ThetaVector& goal = path[static_cast<std::size_t>(place)];
    const double change_rad = largest_change(goal, setpoint.joint_rad);
    const double share = change_rad > step_rad ? step_rad / change_rad : 1.0;
    for (std::size_t k = 0; k < goal.size(); ++k) setpoint.joint_rad[k] += share * (goal[k] - setpoint.joint_rad[k]);
    if (share == 1.0) place -= kPoints;
    arm.follow(interval_s, [&](double) { return setpoint; });
    way.seconds += interval_s;
    way.off_deg = std::max(way.off_deg, largest_difference_deg(setpoint.joint_rad, arm.plant().theta_rad()));
    const FaultList& faults = arm.outputs().faults;
    if (faults.count > 0) way.fault = static_cast<int>(faults.fault[static_cast<std::size_t>(faults.count - 1)].number);
  }
  const Load load = arm.plant().take_load();
  way.contact_N = load.contact_N;
  way.max_motor_N = load.max_motor_N;
  way.is_back = place <= 0.0;
  way.points_left = way.is_back ? 0 : static_cast<std::size_t>(place);
  return way;
}

}  // namespace liana::closed_loop
