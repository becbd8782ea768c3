#include "host/control/arbiter/joint_move.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <utility>

#include "host/control/arbiter/cable_traits.hpp"
#include "host/control/arbiter/serial_traits.hpp"

namespace liana::arbiter {

namespace {

// How fast a move that was refused comes to its speed again: within less than its acceleration.
constexpr double kPaceRise_1_s = 0.01;
constexpr double kLeastPace = 1.0 / 16.0;
// An arm that has gone so far since it was refused last is at another place.
constexpr double kOtherPlace_rad = 2e-3;

// The tip's way on the joint line.
struct TipTravel {
  double travel_m = 0.0;
  double turn_rad = 0.0;
};

// Greatest travel and turn of the tip per unit of s, sampled densely enough for the smooth curve it is.
template <class Arm>
TipTravel steepest_tip_way(const typename Arm::Table& table, const Joints<Arm>& from, const Joints<Arm>& to) {
  constexpr int kSteps = 100;
  TipTravel steepest;
  Pose last = ArmTraits<Arm>::tip_at(table, from);
  for (int i = 1; i <= kSteps; ++i) {
    const Pose tip = ArmTraits<Arm>::tip_at(table, between(from, to, static_cast<double>(i) / kSteps));
    const Vec3 turn = rotation_vector(multiply(tip.quaternion, conjugate(last.quaternion)));
    steepest.travel_m = std::max(steepest.travel_m, norm(subtract(tip.position_m, last.position_m)) * kSteps);
    steepest.turn_rad = std::max(steepest.turn_rad, norm(turn) * kSteps);
    last = tip;
  }
  return steepest;
}

}  // namespace

template <class Arm>
JointMove<Arm>::JointMove(const Table& table, const Joints<Arm>& from_rad, const Joints<Arm>& to_rad, double rate_rad_s,
                          const motion::Swings& swings)
    : table_(table), rate_rad_s_(rate_rad_s), swings_(swings), to_rad_(to_rad), interval_s_(interval_s(table)) {
  plan(from_rad);
}

template <class Arm>
void JointMove<Arm>::plan(const Joints<Arm>& from_rad) {
  using Kind = ArmTraits<Arm>;
  from_rad_ = from_rad;
  time_s_ = 0.0;
  motion::MoveNeeds needs;
  for (std::size_t i = 0; i < Kind::joint_count(table_); ++i) {
    const double way_rad = std::fabs(to_rad_[i] - from_rad[i]);
    needs.speed_s =
        std::max(needs.speed_s, way_rad / (motion::kMoveShare * std::min(rate_rad_s_, Kind::rate_rad_s(table_, i))));
    needs.accel_s2 = std::max(needs.accel_s2, way_rad / Kind::move_accel_rad_s2(table_, i));
  }
  const TipTravel tip = steepest_tip_way<Arm>(table_, from_rad, to_rad_);
  const TipBounds bounds = Kind::tip_bounds(table_);
  needs.add(tip.travel_m, motion::share_of(bounds.linear));
  needs.add(tip.turn_rad, motion::share_of(bounds.angular));
  law_ = motion::TrajectoryTiming(needs, swings_);
}

template <class Arm>
Joints<Arm> JointMove<Arm>::at(double time_s) const {
  return time_s >= law_.duration_s() ? to_rad_ : between(from_rad_, to_rad_, law_.share_at(time_s));
}

template <class Arm>
void JointMove<Arm>::look_first(Work& work, SearchResult taken, Look look) {
  work.forget();
  work_ = &work;
  taken_ = taken;
  look_ = std::move(look);
}

template <class Arm>
bool JointMove<Arm>::is_looked_at(const Joints<Arm>& from_rad) {
  if (work_ == nullptr) return true;
  if (look_)
    work_->start([look = std::exchange(look_, nullptr), from_rad, to_rad = to_rad_] {
      try {
        return look(from_rad, to_rad);
      } catch (const std::exception& error) {  // a look that fails is none that has passed
        return std::string(error.what());
      }
    });
  const std::optional<std::string> refusal = work_->take(taken_ == SearchResult::kInItsInterval);
  if (!refusal) return false;
  work_ = nullptr;
  refusal_ = *refusal;
  return true;
}

template <class Arm>
Goal<Arm> JointMove<Arm>::next(const liana::Outputs<Arm>& now) {
  if (again_.waits(now.at_rest != 0)) return {};
  if (!has_begun_ && now.at_rest == 0) return {};
  const Joints<Arm>& stands_rad = ArmTraits<Arm>::command_rad(now);
  if (!is_looked_at(stands_rad)) return {};
  is_over_ = !refusal_.empty();
  if (is_over_) return {};
  if (!std::exchange(has_begun_, true) && (again_.begins_again() || stands_rad != from_rad_)) plan(stands_rad);
  time_s_ += pace_ * interval_s_;
  pace_ = std::min(1.0, pace_ + kPaceRise_1_s * interval_s_);
  is_over_ = time_s_ >= law_.duration_s() && now.at_rest != 0;
  return at(time_s_);
}

template <class Arm>
bool JointMove<Arm>::refused() {
  const Joints<Arm> asked_rad = at(time_s_);
  double gone_rad = 0.0;
  for (std::size_t i = 0; i < ArmTraits<Arm>::joint_count(table_); ++i)
    gone_rad = std::max(gone_rad, std::fabs(asked_rad[i] - from_rad_[i]));
  if (has_begun_ && gone_rad > kOtherPlace_rad) again_ = AnotherTry{};
  has_begun_ = false;
  pace_ = std::max(kLeastPace, 0.5 * pace_);
  return again_.refused();
}

template class JointMove<cable::CableArm>;
template class JointMove<serial::SerialArm>;
static_assert(MotionGenerator<JointMove<cable::CableArm>, cable::CableArm>);
static_assert(MotionGenerator<JointMove<serial::SerialArm>, serial::SerialArm>);

}  // namespace liana::arbiter
