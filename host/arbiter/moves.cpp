#include "host/arbiter/moves.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/arm/kinematics.hpp"

namespace liana {

namespace {

constexpr double kPeakSpeed = 1.875;         // of minimum jerk, per unit way and time
constexpr double kPeakAccel = 5.7735026919;  // 10 / sqrt(3)
constexpr double kPeakJerk = 60.0;
constexpr std::size_t kMaxPathPoints = 500000;  // 2.7 h of motion at 50 Hz; the oldest go first
constexpr double kSamePoint_rad = 1e-7;
constexpr double kPaceGain = 0.008;  // of the way back, per command interval: full pace after 2 s
constexpr int kMostStarts = 10;

double duration_for(double way, double speed, double accel, double jerk) {
  return std::max({kPeakSpeed * way / speed, std::sqrt(kPeakAccel * way / accel), std::cbrt(kPeakJerk * way / jerk)});
}

ThetaVector between(const ThetaVector& a, const ThetaVector& b, double share) {
  ThetaVector theta{};
  for (std::size_t i = 0; i < theta.size(); ++i) theta[i] = a[i] + share * (b[i] - a[i]);
  return theta;
}

// Greatest tip travel per unit of s on the joint line, sampled densely enough for the smooth curve it is.
double steepest_tip_travel_m(const RobotTable& table, const ThetaVector& from, const ThetaVector& to) {
  constexpr int kSteps = 100;
  double steepest = 0.0;
  Vec3 last = forward_kinematics(table, from).tip_in_base.position_m;
  for (int i = 1; i <= kSteps; ++i) {
    const Vec3 tip =
        forward_kinematics(table, between(from, to, static_cast<double>(i) / kSteps)).tip_in_base.position_m;
    steepest = std::max(steepest, norm(subtract(tip, last)) * kSteps);
    last = tip;
  }
  return steepest;
}

}  // namespace

double minimum_jerk(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
}

JointMove::JointMove(const RobotTable& table, const ThetaVector& from_rad, const ThetaVector& to_rad, double rate_rad_s)
    : from_rad_(from_rad), to_rad_(to_rad) {
  double way_rad = 0.0;
  for (std::size_t i = 0; i < from_rad.size(); ++i) way_rad = std::max(way_rad, std::fabs(to_rad[i] - from_rad[i]));
  const double joint_s =
      std::max(kPeakSpeed * way_rad / (kMoveShare * rate_rad_s),
               std::sqrt(kPeakAccel * way_rad / (kMoveAccelShare * table.limits.theta_accel_rad_s2)));
  const double tip_s =
      kPeakSpeed * steepest_tip_travel_m(table, from_rad, to_rad) / (kMoveShare * table.limits.tip_speed_m_s);
  duration_s_ = std::max(joint_s, tip_s);
}

ThetaVector JointMove::at(double time_s) const {
  return time_s >= duration_s_ ? to_rad_ : between(from_rad_, to_rad_, minimum_jerk(time_s / duration_s_));
}

TipLine::TipLine(const RobotTable& table, const Pose& from, const Pose& to, double speed_m_s) : from_(from), to_(to) {
  const MotionLimits& l = table.limits;
  turn_rad_ = rotation_vector(multiply(to.quaternion, conjugate(from.quaternion)));
  const double way_m = norm(subtract(to.position_m, from.position_m));
  duration_s_ =
      std::max(duration_for(way_m, kMoveShare * speed_m_s, kMoveShare * l.tip_accel_m_s2, kMoveShare * l.tip_jerk_m_s3),
               duration_for(norm(turn_rad_), kMoveShare * l.tip_rate_rad_s, kMoveShare * l.tip_angular_accel_rad_s2,
                            kMoveShare * l.tip_angular_jerk_rad_s3));
}

Pose TipLine::at(double time_s) const {
  if (time_s >= duration_s_) return to_;
  const double s = minimum_jerk(time_s / duration_s_);
  return {add(from_.position_m, scale(subtract(to_.position_m, from_.position_m), s)),
          normalize(multiply(quaternion_of(scale(turn_rad_, s)), from_.quaternion))};
}

void PathMemory::note(std::uint64_t tick, const ThetaVector& theta_rad) {
  if (!points_.empty()) {
    double change = 0.0;
    for (std::size_t i = 0; i < theta_rad.size(); ++i)
      change = std::max(change, std::fabs(theta_rad[i] - points_.back().theta_rad[i]));
    if (change < kSamePoint_rad) return;
  }
  points_.push_back({tick, theta_rad});
  if (points_.size() > kMaxPathPoints) points_.pop_front();
}

std::optional<ThetaVector> PathMemory::step_back(std::uint64_t until_tick) {
  if (points_.empty() || points_.back().tick < until_tick) return std::nullopt;
  const ThetaVector theta = points_.back().theta_rad;
  points_.pop_back();
  return theta;
}

std::optional<ThetaVector> WayBack::next(PathMemory& path) {
  if (!to_rad_) {  // at rest: the newest point is where the command stands
    to_rad_ = path.step_back(until_tick_);
    if (!to_rad_ || ended_) return std::nullopt;
    share_ = 1.0;
  }
  pace_ = std::min(kWayBackPace, pace_ + kPaceGain);
  share_ += pace_;
  if (share_ >= 1.0) {
    share_ -= 1.0;
    from_rad_ = *to_rad_;
    to_rad_ = path.step_back(until_tick_);
    ended_ = !to_rad_;
  }
  return ended_ ? from_rad_ : between(from_rad_, *to_rad_, share_);
}

bool WayBack::start_again() {
  pace_ = 0.0;
  to_rad_ = std::nullopt;
  ended_ = false;
  return ++starts_ < kMostStarts;
}

}  // namespace liana
