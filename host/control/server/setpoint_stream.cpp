#include "host/control/server/setpoint_stream.hpp"

#include <algorithm>

#include "firmware_like/math/trig.hpp"
#include "host/api/server/request_error.hpp"
#include "host/api/server/request_text.hpp"

namespace liana::server {

namespace {

constexpr double kDrift = 1e-3;          // clocks of two machines run apart less than this
constexpr double kSumRounding_s = 1e-6;  // of sums of times
constexpr double kReached_m = 1e-5, kReached_deg = 1e-3;

double distance_m(const Pose& a, const Pose& b) { return norm(subtract(a.position_m, b.position_m)); }

double turn_deg(const Pose& a, const Pose& b) {
  return norm(rotation_vector(multiply(a.quaternion, conjugate(b.quaternion)))) / kDegree;
}

bool is_near(const Pose& a, const Pose& b, double most_m, double max_deg) {
  return distance_m(a, b) <= most_m && turn_deg(a, b) <= max_deg;
}

[[noreturn]] void too_far(double far, double most, const std::string& unit, const std::string& from) {
  throw api::RequestError("out_of_range", "goal = " + api::roughly(far) + unit + " from " + from + ": allowed 0 to " +
                                              api::text_of(most) + unit +
                                              " in one servo_cp: use move_cp, or smaller steps");
}

bool is_setpoint(const api::RequestRow& row) {
  return std::any_of(row.fields.begin(), row.fields.end(),
                     [](const api::RequestField& field) { return std::string_view(field.name) == "sequence"; });
}

}  // namespace

void SetpointStream::check(const api::RequestRow& row, const api::Arguments& setpoint, double now_s,
                           const Pose& tip) const {
  if (is_setpoint(row)) check_stamp(setpoint, now_s);
  if (row.motion == api::Motion::kStreams) check_jump(setpoint.pose("goal"), tip);
}

void SetpointStream::check_stamp(const api::Arguments& setpoint, double now_s) const {
  if (setpoint.has("sequence") && setpoint.integer("sequence") <= sequence_) {
    throw api::RequestError("refused", "sequence = " + std::to_string(setpoint.integer("sequence")) + ": allowed " +
                                           std::to_string(sequence_ + 1) + " and more, as the owner's last one was " +
                                           std::to_string(sequence_) + ": give every setpoint a greater number");
  }
  if (!setpoint.has("time_s") || !clock_s_) return;
  const double clock_s = setpoint.number("time_s");
  if (clock_s < *clock_s_) {
    throw api::RequestError("refused",
                            "time_s = " + api::text_of(clock_s) + ": allowed " + api::text_of(*clock_s_) +
                                " and more, as the owner's last one was that: give times of a clock that never "
                                "goes back");
  }
  const double late_s = now_s - clock_s - (lag_s_ + kDrift * (now_s - noted_s_));
  if (setpoint.has("ttl_s") && late_s > setpoint.number("ttl_s") + kSumRounding_s) {
    throw api::RequestError("refused", "time_s = " + api::text_of(clock_s) + ": this setpoint comes " +
                                           api::roughly(late_s) + " s later than the quickest: allowed 0 to " +
                                           api::text_of(setpoint.number("ttl_s")) + " s, its ttl_s: send newer ones");
  }
}

void SetpointStream::check_jump(const Pose& goal, const Pose& tip) const {
  const double most_m = api::kJump_s * bounds_.tip_speed_m_s, max_deg = api::kJump_s * bounds_.tip_rate_deg_s;
  const Pose& before = goal_.value_or(tip);
  if (is_near(goal, before, most_m, max_deg) || is_near(goal, tip, most_m, max_deg)) return;
  const std::string from = goal_ ? "the goal before it" : "where the tip is commanded";
  if (distance_m(goal, before) > most_m) too_far(distance_m(goal, before), most_m, " m", from);
  too_far(turn_deg(goal, before), max_deg, " deg", from);
}

void SetpointStream::note(const api::RequestRow& row, const api::Arguments& setpoint, double now_s) {
  if (row.motion == api::Motion::kReplaces) end();
  if (!is_setpoint(row)) return;
  if (setpoint.has("sequence")) sequence_ = setpoint.integer("sequence");
  if (setpoint.has("time_s")) {
    const double lag_s = now_s - setpoint.number("time_s");
    lag_s_ = clock_s_ ? std::min(lag_s, lag_s_ + kDrift * (now_s - noted_s_)) : lag_s;
    clock_s_ = setpoint.number("time_s");
    noted_s_ = now_s;
  }
  if (row.motion != api::Motion::kStreams) return;
  goal_ = setpoint.pose("goal");
  goal_s_ = now_s;
  ttl_s_.reset();
  if (setpoint.has("ttl_s")) ttl_s_ = setpoint.number("ttl_s");
}

void SetpointStream::end() {
  goal_.reset();
  ttl_s_.reset();
}

std::optional<double> SetpointStream::overdue(double next_s, const Pose& tip) {
  if (!ttl_s_ || next_s <= goal_s_ + *ttl_s_ + kSumRounding_s) return std::nullopt;
  const std::optional<double> ttl_s = is_near(*goal_, tip, kReached_m, kReached_deg) ? std::nullopt : ttl_s_;
  end();
  return ttl_s;
}

}  // namespace liana::server
