#include "host/arbiter/joint_move.hpp"

#include <algorithm>
#include <cmath>

#include "host/arbiter/cable_kind.hpp"
#include "host/arbiter/serial_kind.hpp"
#include "host/arbiter/time_law.hpp"

namespace liana {

namespace {

// Greatest tip travel per unit of s on the joint line, sampled densely enough for the smooth curve it is.
template <class Arm>
double steepest_tip_travel_m(const typename Arm::Table& table, const Joints<Arm>& from, const Joints<Arm>& to) {
  constexpr int kSteps = 100;
  double steepest = 0.0;
  Vec3 last = ArmKind<Arm>::tip_at(table, from).position_m;
  for (int i = 1; i <= kSteps; ++i) {
    const Vec3 tip = ArmKind<Arm>::tip_at(table, between(from, to, static_cast<double>(i) / kSteps)).position_m;
    steepest = std::max(steepest, norm(subtract(tip, last)) * kSteps);
    last = tip;
  }
  return steepest;
}

}  // namespace

template <class Arm>
JointMove<Arm>::JointMove(const Table& table, const Joints<Arm>& from_rad, const Joints<Arm>& to_rad, double rate_rad_s)
    : from_rad_(from_rad), to_rad_(to_rad), interval_s_(interval_s(table)) {
  using Kind = ArmKind<Arm>;
  for (std::size_t i = 0; i < Kind::joint_count(table); ++i) {
    const double way_rad = std::fabs(to_rad[i] - from_rad[i]);
    const double rate = std::min(rate_rad_s, Kind::rate_rad_s(table, i));
    duration_s_ = std::max({duration_s_, time_for_speed(way_rad, kMoveShare * rate),
                            time_for_accel(way_rad, Kind::move_accel_rad_s2(table, i))});
  }
  const double tip_s = time_for_speed(steepest_tip_travel_m<Arm>(table, from_rad, to_rad),
                                      kMoveShare * Kind::tip_bounds(table).linear.speed);
  duration_s_ = std::max(duration_s_, tip_s);
}

template <class Arm>
Joints<Arm> JointMove<Arm>::at(double time_s) const {
  return time_s >= duration_s_ ? to_rad_ : between(from_rad_, to_rad_, minimum_jerk(time_s / duration_s_));
}

template <class Arm>
Goal<Arm> JointMove<Arm>::next(const liana::Outputs<Arm>& now) {
  time_s_ += interval_s_;
  is_over_ = time_s_ >= duration_s_ && now.at_rest != 0;
  return at(time_s_);
}

template class JointMove<cable::CableArm>;
template class JointMove<serial::SerialArm>;
static_assert(WayOfMoving<JointMove<cable::CableArm>, cable::CableArm>);
static_assert(WayOfMoving<JointMove<serial::SerialArm>, serial::SerialArm>);

}  // namespace liana
