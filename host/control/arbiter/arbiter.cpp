#include "host/control/arbiter/arbiter.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "firmware_like/safety/faults.hpp"
#include "host/api/server/request_error.hpp"
#include "host/control/arbiter/cable_traits.hpp"
#include "host/control/arbiter/serial_traits.hpp"

namespace liana::arbiter {

template <class Arm>
Arbiter<Arm>::Arbiter(const Table& table, const SpeedZone& zone, SearchResult taken, PathCheck<Arm> check)
    : table_(table),
      zone_(zone),
      tip_speed_m_s_(Kind::tip_bounds(table).linear.speed),
      taken_(taken),
      path_check_(std::move(check)) {}

template <class Arm>
void Arbiter<Arm>::require_ready(const Now& now) const {
  if (now.faults.count > 0) {
    throw api::RequestError(
        "fault", std::string("fault ") + fault_info(now.faults.fault[0].number).name + " is latched: clear it first");
  }
  require_enabled(now);
}

template <class Arm>
void Arbiter<Arm>::require_enabled(const Now& now) const {
  if (now.state != OperatingState::kEnabled)
    throw api::RequestError("not_enabled", "the arm is not enabled: enable it first");
}

template <class Arm>
void Arbiter<Arm>::require_free(const Now& now) const {
  require_ready(now);
  if (is_busy()) throw api::RequestError("busy", "a planned move is under way: wait for it or send hold");
}

template <class Arm>
bool Arbiter<Arm>::is_busy() const {
  return std::visit([](const auto& way) { return way.kIsPlanned; }, way_);
}

template <class Arm>
void Arbiter<Arm>::move_joints(const Now& now, const Joints<Arm>& goal_rad, double rate_rad_s,
                               const motion::Swings& swings) {
  require_free(now);
  auto& move = way_.template emplace<JointMove<Arm>>(table_, Kind::command_rad(now), goal_rad, rate_rad_s, swings);
  if (path_check_)
    move.look_first(move_work_, taken_, [check = path_check_](const Joints<Arm>& from_rad, const Joints<Arm>& to_rad) {
      return check({from_rad, to_rad}, std::nullopt);
    });
  motion_begins();
}

template <class Arm>
void Arbiter<Arm>::move_line(const Now& now, const Pose& goal, const motion::Swings& swings) {
  require_free(now);
  const auto* target = std::get_if<TipTarget<Arm>>(&way_);
  const Pose from = target != nullptr ? target->goal() : now.tip_command;
  way_.template emplace<LineMove<Arm>>(table_, from, goal, tip_speed_m_s_, swings);
  motion_begins();
}

template <class Arm>
void Arbiter<Arm>::servo_tip(const Now& now, const Pose& goal) {
  require_free(now);
  way_.template emplace<TipTarget<Arm>>(goal, wishes_, true);
  motion_begins();
}

template <class Arm>
void Arbiter<Arm>::move_path(const Now& now, const PathRequest<Arm>& request) {
  require_free(now);
  if (now.at_rest == 0) throw api::RequestError("busy", "a path starts from rest: wait for it or send hold");
  const PathRequest<Arm> admitted = admit_path<Arm>(table_, Kind::command_rad(now), request);
  stop_asking();
  path_work_.start([table = table_, zone = zone_, check = path_check_, from = Kind::command_rad(now), admitted] {
    return look_at_path<Arm>(table, zone, check, from, admitted);
  });
  way_.template emplace<PathMove<Arm>>(path_work_, taken_, request.hash);
  motion_begins();
}

template <class Arm>
void Arbiter<Arm>::servo_target(const Now& now, const visual_servo::ServoRequest& request) {
  require_free(now);
  const TipBounds bounds = Kind::tip_bounds(table_);
  visual_servo::ServoRequest admitted = request;
  visual_servo::ApproachLimits& limits = admitted.limits;
  limits.speed_m_s = std::min(limits.speed_m_s, bounds.linear.speed);
  limits.lateral_speed_m_s = std::min(limits.lateral_speed_m_s, bounds.linear.speed);
  limits.rate_rad_s = std::min(limits.rate_rad_s, bounds.angular.speed);
  servo_.begin(admitted, now.tip_command);
  way_.template emplace<ServoMove<Arm>>(servo_);
  motion_begins();
}

template <class Arm>
std::optional<PathProgress> Arbiter<Arm>::path() const {
  const auto* move = std::get_if<PathMove<Arm>>(&way_);
  return move != nullptr ? std::optional(move->progress()) : std::nullopt;
}

template <class Arm>
void Arbiter<Arm>::tell(event::PathEvent what, const PathMove<Arm>& move, const std::string& rest) {
  const PathProgress path = move.progress();
  path_news_.push_back({what, path, move.duration_s(table_), "path " + path.hash + rest});
}

template <class Arm>
void Arbiter<Arm>::hold(const std::string& why) {
  stop_asking(why);
}

// A path that is cut short says how far it has come, and so does a way back.
template <class Arm>
void Arbiter<Arm>::stop_asking(const std::string& why) {
  if (std::holds_alternative<RetractMove<Arm>>(way_)) retract_request_.end(why, command_rad_);
  servo_.end(why);
  const auto* move = std::get_if<PathMove<Arm>>(&way_);
  if (move != nullptr && !move->is_over()) {
    const int percent = static_cast<int>(100.0 * move->progress().share);
    tell(event::PathEvent::kStops, *move, " stops at " + std::to_string(percent) + " % of its time");
  }
  way_.template emplace<Idle>();
}

template <class Arm>
void Arbiter<Arm>::tell_of_outlook(const PathMove<Arm>& move) {
  if (!move.outlook()->refusal.empty())
    return tell(event::PathEvent::kRefused, move, " is refused: " + move.outlook()->refusal);
  const int time_s = static_cast<int>(std::ceil(move.duration_s(table_)));
  tell(event::PathEvent::kBegins, move, " begins, " + std::to_string(time_s) + " s");
}

template <class Arm>
void Arbiter<Arm>::require_way_back(const Now& now, std::uint64_t until_tick) const {
  if (!allow_retract(now.faults)) {
    const FaultInfo& fault = fault_info(now.faults.fault[0].number);
    throw api::RequestError("fault", std::string("fault ") + fault.name +
                                         " is latched, with which the arm cannot be led back: " + fault.remedy);
  }
  require_enabled(now);
  const std::string why = retract_request_.why_no_way(until_tick);
  if (!why.empty()) throw api::RequestError("refused", why);
}

template <class Arm>
void Arbiter<Arm>::retract(const Now& now, std::uint64_t until_tick) {
  require_way_back(now, until_tick);
  stop_asking("another retract was asked for");
  wishes_ = {};
  retract_request_.begin(until_tick);
  way_.template emplace<RetractMove<Arm>>(table_, retract_request_.path(), until_tick);
  motion_begins();
}

template <class Arm>
RetractState Arbiter<Arm>::retract_state() const {
  const auto* back = std::get_if<RetractMove<Arm>>(&way_);
  const RetractState& last = retract_request_.last_retract();
  if (back == nullptr) return last;
  const std::size_t left = back->points_left();
  return {back->phase(), left, std::max(last.points, left), ""};  // until the arm rests the path still grows
}

template <class Arm>
void Arbiter<Arm>::stay_if_idle(const Now& now) {
  if (std::holds_alternative<Idle>(way_)) way_.template emplace<TipTarget<Arm>>(now.tip_command, wishes_);
}

template <class Arm>
void Arbiter<Arm>::ask_anew() {
  if (auto* target = std::get_if<TipTarget<Arm>>(&way_)) target->ask_anew();
}

template <class Arm>
bool Arbiter<Arm>::refused(const std::string& why, bool may_pass_slower) {
  const auto* back = std::get_if<RetractMove<Arm>>(&way_);
  if ((back != nullptr || may_pass_slower) && std::visit([](auto& way) { return way.refused(); }, way_)) return true;
  const std::string detail = why.empty() ? "" : ": " + why;
  stop_asking((back != nullptr ? back->why_ended() : "refused") + detail);
  return false;
}

template <class Arm>
std::optional<typename Arm::Setpoint> Arbiter<Arm>::next_setpoint(std::uint64_t tick, const Now& now) {
  if (!begin_interval(tick, now)) return std::nullopt;
  return ask(now);
}

template <class Arm>
bool Arbiter<Arm>::begin_interval(std::uint64_t tick, const Now& now) {
  // The newest tick's drives were read at its beginning.
  servo_.note_tip((static_cast<double>(tick) - 1.0) * table_.tick_s, Kind::tip_at(table_, Kind::measured_rad(now)));
  if (now.state != OperatingState::kEnabled) {
    stop_asking("the arm is not enabled any more");
    retract_request_.wait();
    wishes_ = {};
    return false;
  }
  command_rad_ = Kind::command_rad(now);
  const double command_m_s = norm(subtract(now.tip_command.position_m, command_at_m_)) / interval_s(table_);
  command_at_m_ = now.tip_command.position_m;
  start_ramp_.note(command_m_s, interval_s(table_));
  goal_ramp_.note(command_m_s, interval_s(table_));
  speed_rise_.pass(interval_s(table_));
  pace_ = pace_left(now);
  const auto* back = std::get_if<RetractMove<Arm>>(&way_);
  const bool stops = now.at_rest == 0 && (back != nullptr || std::holds_alternative<Idle>(way_));
  retract_request_.stand(tick, command_rad_, back != nullptr && back->has_begun(), stops);
  return true;
}

template <class Arm>
std::optional<typename Arm::Setpoint> Arbiter<Arm>::ask(const Now& now) {
  const auto* path = std::get_if<PathMove<Arm>>(&way_);
  const bool awaits = path != nullptr && !path->outlook();
  const Goal<Arm> goal = std::visit([&](auto& way) { return way.next(now); }, way_);
  if (awaits && path->outlook()) tell_of_outlook(*path);
  if (std::visit([](const auto& way) { return way.is_over(); }, way_)) end_motion();
  return setpoint_for(now, goal);
}

// Where a line has ended the tip stays, until nothing more needs to be asked for.
template <class Arm>
void Arbiter<Arm>::end_motion() {
  if (const auto* line = std::get_if<LineMove<Arm>>(&way_)) {
    const Pose end = line->end();
    way_.template emplace<TipTarget<Arm>>(end, wishes_);
    return;
  }
  if (const auto* back = std::get_if<RetractMove<Arm>>(&way_)) return stop_asking(back->why_ended());
  const auto* move = std::get_if<JointMove<Arm>>(&way_);
  if (move != nullptr && !move->refusal().empty())
    path_news_.push_back({event::PathEvent::kRefused,
                          {"move_jp", 0.0},
                          0.0,
                          "move_jp is refused: " + move->refusal() + ". " + Kind::kOtherWay + ", or retract"});
  const auto* path = std::get_if<PathMove<Arm>>(&way_);
  if (path != nullptr && path->outlook()->refusal.empty()) tell(event::PathEvent::kArrives, *path, " has arrived");
  stop_asking();
}

template <class Arm>
typename Arm::Setpoint Arbiter<Arm>::steer(const Now& now, const Pose& goal) {
  way_.template emplace<TipTarget<Arm>>(goal, wishes_);
  return tip_setpoint(now, goal);
}

template <class Arm>
std::optional<typename Arm::Setpoint> Arbiter<Arm>::setpoint_for(const Now& now, const Goal<Arm>& goal) {
  if (const auto* tip_in_base = std::get_if<Pose>(&goal)) return tip_setpoint(now, *tip_in_base);
  const auto* joint_rad = std::get_if<Joints<Arm>>(&goal);
  if (joint_rad == nullptr) return std::nullopt;
  const bool retracts =
      std::holds_alternative<RetractMove<Arm>>(way_) && (now.faults.count > 0 || Kind::recovers(table_, now));
  return joint_setpoint(*joint_rad, retracts ? CommandKind::kRetract : CommandKind::kJoint);
}

template <class Arm>
typename Arm::Setpoint Arbiter<Arm>::tip_setpoint(const Now& now, const Pose& goal) {
  Setpoint setpoint;
  setpoint.kind = CommandKind::kTip;
  setpoint.tip_in_base = goal;
  Kind::add_wishes(wishes_, setpoint);
  const auto* target = std::get_if<TipTarget<Arm>>(&way_);
  const double max_m_s = tip_speed_m_s_ * (target != nullptr ? pace_ * target->speed_share() : 1.0);
  const double zone_m_s =
      zone_.advice_at(now.tip_command.position_m, zone_.advice_at(goal.position_m, SpeedRise::kMost_m_s));
  setpoint.tip_speed_m_s = std::min(max_m_s, speed_rise_.limited(zone_m_s));
  if (target != nullptr && target->is_distant())
    setpoint.tip_speed_m_s = std::min(setpoint.tip_speed_m_s, goal_ramp_.speed_m_s());
  if (zone_.slows_at(now.tip_command.position_m))
    setpoint.tip_speed_m_s = std::min(setpoint.tip_speed_m_s, start_ramp_.speed_m_s());
  const Vec3 way_m = subtract(goal.position_m, now.tip_command.position_m);
  const double left_m_s = speed_left_m_s(way_m, Kind::tip_bounds(table_).linear.speed);
  setpoint.tip_speed_m_s = std::min(setpoint.tip_speed_m_s, left_m_s);
  return setpoint;
}

template <class Arm>
double Arbiter<Arm>::speed_left_m_s(const Vec3&, double limit_m_s) {
  return limit_m_s;
}

template <class Arm>
typename Arm::Setpoint Arbiter<Arm>::joint_setpoint(const Joints<Arm>& joint_rad, CommandKind kind) const {
  Setpoint setpoint;
  setpoint.kind = kind;
  setpoint.joint_rad = joint_rad;
  setpoint.tip_speed_m_s = Kind::tip_bounds(table_).linear.speed;
  return setpoint;
}

template class Arbiter<cable::CableArm>;
template class Arbiter<serial::SerialArm>;
static_assert(MotionGenerator<TipTarget<cable::CableArm>, cable::CableArm>);
static_assert(MotionGenerator<LineMove<cable::CableArm>, cable::CableArm>);
static_assert(MotionGenerator<RetractMove<cable::CableArm>, cable::CableArm>);

}  // namespace liana::arbiter
