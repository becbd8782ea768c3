#include "host/control/verification/arm_limits.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/arm/let_go.hpp"
#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/serial/drive_units.hpp"

namespace liana::verification {

namespace {

constexpr double kPushBeyond_m = 0.001;  // a push that ends at its bound has stopped within this

void judge_tension(const cable::RobotParams& table, const cable::Outputs& outputs, Judge& judge) {
  const auto cables = static_cast<std::size_t>(table.cable_count());
  for (auto i = static_cast<std::size_t>(table.feed_count()); i < cables; ++i) {
    const double tension_N = outputs.tension_plan_N[i];
    if (cable::is_planned_released(table, outputs.tension_plan_N, i)) continue;
    judge.check(Refusal::kTension, "planned tension of cable", kNewtons, static_cast<int>(i), tension_N,
                table.tension.ceiling_free_N);
    judge.require(tension_N * kRounding >= table.tension.floor_motor_N, Refusal::kTension,
                  "planned tension under the floor at cable", static_cast<int>(i));
  }
}

// The hardest pulled cable of an arm that stands there with its load; what friction holds is left out.
struct Hardest {
  std::size_t cable = 0;
  double tension_N = 0.0;
};

Hardest hardest_at(const cable::RobotParams& table, const cable::Outputs& outputs) {
  const cable::TensionPlan plan = plan_at_rest(table, cable_layout(table), outputs.theta_command_rad, outputs.load_Nm);
  const auto end = plan.motor_N.begin() + table.cable_count(), hardest = std::max_element(plan.motor_N.begin(), end);
  return {static_cast<std::size_t>(hardest - plan.motor_N.begin()), *hardest};
}

void judge_push(const serial::TorqueParams& most, const serial::InsertStatus& push, Judge& judge) {
  if (push.phase == serial::InsertPhase::kNone || push.phase == serial::InsertPhase::kYielding) return;
  judge.check(Refusal::kPushTube, "way of the push along its axis", kMillimetres, -1, push.travel_m,
              most.most_travel_m + kPushBeyond_m);
  judge.check(Refusal::kPushTube, "way of the push beside its axis", kMillimetres, -1, push.aside_m,
              most.most_aside_m + kPushBeyond_m);
  judge.check(Refusal::kPushTube, "set force of the push", kNewtons, -1, push.set_N, most.most_force_N);
}

}  // namespace

void judge_targets(const cable::RobotParams& table, const cable::Outputs* before, const cable::Outputs& after,
                   Judge& judge) {
  judge_tension(table, after, judge);
  if (before == nullptr) return;
  const double way_m = kTargetSpeedMargin * table.limits.cable_speed_m_s * table.tick_s;
  const auto cables = static_cast<std::size_t>(table.cable_count());
  for (std::size_t i = 0; i < cables; ++i) {
    judge.check(Refusal::kCableSpeed, "travel per tick of cable", kMillimetres, static_cast<int>(i),
                after.payout_command_m[i] - before->payout_command_m[i], way_m);
  }
}

void judge_targets(const serial::RobotParams& table, const serial::Outputs* before, const serial::Outputs& after,
                   Judge& judge) {
  if (before == nullptr) return;
  for (std::size_t i = 0; i < table.joints(); ++i) {
    const double way_rad = kTargetSpeedMargin * table.joint[i].rate_rad_s * table.tick_s;
    judge.check(Refusal::kJointTravel, "travel per tick of joint", kDegrees, static_cast<int>(i),
                after.joint_command_rad[i] - before->joint_command_rad[i], way_rad);
  }
}

void judge_hold(const cable::RobotParams& table, const cable::Outputs& now, const cable::Outputs& ends, Judge& judge) {
  if (!has_static_load(table)) return;
  const Hardest hardest = hardest_at(table, ends);
  if (hardest.tension_N > table.tension.ceiling_free_N && hardest.tension_N <= hardest_at(table, now).tension_N) return;
  judge.check(Refusal::kTension, "tension that holds the load, of cable", kNewtons, static_cast<int>(hardest.cable),
              hardest.tension_N, table.tension.ceiling_free_N);
}

void judge_joints(const cable::RobotParams& table, const cable::Outputs& first, const cable::Outputs& outputs,
                  Judge& judge) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.theta_count()); ++i) {
    const double from_rad = std::fabs(first.theta_command_rad[i]);
    judge.check(Refusal::kJointAngle, "theta", kDegrees, static_cast<int>(i), outputs.theta_command_rad[i],
                std::fmax(table.segment[i / 2].theta_limit_rad, from_rad));
    judge.check(Refusal::kJointRate, "rate of theta", kDegreesPerSecond, static_cast<int>(i),
                outputs.theta_rate_rad_s[i], table.limits.theta_rate_rad_s);
  }
}

// A range need not be symmetric: what counts is the distance from its middle.
void judge_joints(const serial::RobotParams& table, const serial::Outputs&, const serial::Outputs& outputs,
                  Judge& judge) {
  for (std::size_t i = 0; i < table.joints(); ++i) {
    const serial::JointParams& joint = table.joint[i];
    judge.check(Refusal::kJointAngle, "angle from the middle of its range of joint", kDegrees, static_cast<int>(i),
                outputs.joint_command_rad[i] - 0.5 * (joint.low_rad + joint.high_rad),
                0.5 * (joint.high_rad - joint.low_rad));
    judge.check(Refusal::kJointRate, "rate of joint", kDegreesPerSecond, static_cast<int>(i),
                outputs.joint_rate_rad_s[i], joint.rate_rad_s);
  }
  judge_push(table.torque, outputs.push, judge);
}

}  // namespace liana::verification
