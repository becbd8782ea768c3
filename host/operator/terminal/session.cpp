#include "host/operator/terminal/session.hpp"

#include <algorithm>
#include <numbers>
#include <string_view>
#include <utility>

namespace liana::terminal {
namespace {

constexpr double kFaster = 1.25;
// In lianad's refusal: how a client takes motion by name.
constexpr std::string_view kByName = "(acquire with from)", kByKey = "(press t again)";
constexpr double kMinTip_m_s = 0.001, kMinTurn_rad_s = 0.005;

Json pose_json(const Pose& pose) {
  const auto& [p, q] = pose;
  return {p[0], p[1], p[2], q[0], q[1], q[2], q[3]};
}

Json state_command(const char* command) { return {{"op", "state_command"}, {"command", command}}; }

// What a key asks for that is neither a jog nor for us alone; null for those.
Json plain_request_of(Deed deed) {
  switch (deed) {
    case Deed::kStop:
      return {{"op", "stop"}, {"reason", "key in the terminal"}};
    case Deed::kHold:
      return {{"op", "hold"}};
    case Deed::kTake:
      return {{"op", "acquire"}};
    case Deed::kEnable:
      return state_command("enable");
    case Deed::kDisable:
      return state_command("disable");
    case Deed::kClear:
      return state_command("clear");
    case Deed::kRetract:
      return {{"op", "retract"}};
    default:
      return nullptr;
  }
}

JogLimits limits_of(const Json& welcome) {
  const Json& limits = welcome.at("robot").at("limits");
  return {limits.at("tip_speed_m_s").get<double>(),
          limits.at("tip_rate_deg_s").get<double>() * std::numbers::pi / 180.0};
}

}  // namespace

Session::Session(std::string name, const Json& welcome, double now_s)
    : name_(std::move(name)),
      robot_(welcome.at("robot").value("name", "")),
      is_fast_(welcome.value("time_mode", "") == "fast"),
      heard_s_(now_s),
      limits_(limits_of(welcome)) {
  speed_.tip_m_s = std::min(speed_.tip_m_s, limits_.tip_m_s);
  speed_.turn_rad_s = std::min(speed_.turn_rad_s, limits_.turn_rad_s);
}

std::vector<Json> Session::press(const Key& key, double now_s) {
  const bool is_stop = key.deed == Deed::kStop, is_silent = silent_s(now_s) > 0.0;
  if (key.deed == Deed::kJog) {
    if (is_silent) return {};
    const std::string why = why_still();
    if (why.empty()) {
      held_.press(key, now_s);
    } else {
      said_ = why;
    }
    return {};
  }
  if (key.deed == Deed::kFaster) change_speed(kFaster);
  if (key.deed == Deed::kSlower) change_speed(1.0 / kFaster);
  if (key.deed == Deed::kFrame) speed_.in_tip = !speed_.in_tip;
  if (key.deed == Deed::kEnd) wants_end_ = true;
  Json request = request_of(key);
  if (request.is_null()) return {};
  held_.let_go();
  leant_.reset();
  goal_.reset();
  if (is_silent && (!is_stop || stop_)) return {};
  said_.clear();
  request = asked(std::move(request));
  if (is_stop) stop_ = Stop{last_id_, stop_ ? stop_->since_s : now_s};
  if (key.deed == Deed::kTake) take_id_ = last_id_;
  return {std::move(request)};
}

// To take motion from an owner by its name is for the second press: the first one's refusal says who that is.
Json Session::request_of(const Key& key) {
  Json request = plain_request_of(key.deed);
  if (key.deed == Deed::kTake && !take_from_.empty() && take_from_ == state_.value("owner", ""))
    request["from"] = take_from_;
  if (!request.is_null()) take_from_.clear();
  return request;
}

std::vector<Json> Session::pass(double now_s) {
  if (silent_s(now_s) > 0.0) {
    held_.let_go();
    goal_.reset();
    return {};
  }
  const std::string why = leant_ ? why_still() : "";
  if (!why.empty()) said_ = why;
  if (!held_.any(now_s) && (!leant_ || !why.empty())) {
    if (!std::exchange(goal_, std::nullopt) || !owns_motion()) return {};
    return {asked({{"op", "hold"}})};
  }
  const auto now = commanded();
  if (!now) return {};
  if (!goal_) goal_s_ = now_s;
  goal_ = next_goal(goal_.value_or(*now), *now, wanted(now_s), speed_, now_s - goal_s_, limits_);
  goal_s_ = now_s;
  return {asked({{"op", "servo_cp"}, {"goal", pose_json(*goal_)}, {"ttl_s", kTimeToLive_s}})};
}

void Session::hear(const Json& message, double now_s) {
  const std::string op = message.value("op", "");
  if (op == "state") {
    state_ = message;
    heard_s_ = now_s;
  }
  if (op == "event" && message.value("kind", "") != "client") said_ = message.value("text", "");
  if (op == "ok" || op == "error") hear_answer(message);
}

void Session::hear_answer(const Json& answer) {
  const int id = answer.value("id", 0);
  const bool is_error = answer.value("op", "") == "error";
  if (stop_ && stop_->id == id && !is_error) stop_.reset();
  if (!is_error) return;
  said_ = answer.value("message", "");
  goal_.reset();  // begins anew at the commanded tip
  if (id != take_id_ || answer.value("code", "") != "not_owner") return;
  take_from_ = state_.value("owner", "");
  if (const std::size_t at = said_.find(kByName); at != std::string::npos) said_.replace(at, kByName.size(), kByKey);
}

std::vector<std::string> Session::lines(Size size, double now_s) const {
  return status_lines(state_, {name_, robot_, speed_, goal_.has_value(), said_, silent_s(now_s), unconfirmed_s(now_s)},
                      size);
}

double Session::silent_s(double now_s) const {
  const double silent_s = now_s - heard_s_;
  return !is_fast_ && silent_s > kMaxSilence_s ? silent_s : 0.0;
}

double Session::unconfirmed_s(double now_s) const {
  const double waited_s = stop_ ? now_s - stop_->since_s : 0.0;
  return waited_s > kMaxSilence_s ? waited_s : 0.0;
}

std::string Session::why_still() const {
  if (!owns_motion()) return "nothing moves before you take motion: t";
  return state_.value("state", "") == "ENABLED" ? "" : "nothing moves before the arm is enabled: n";
}

Direction Session::wanted(double now_s) const {
  const Direction keys = held_.direction(now_s), stick = leant_.value_or(Direction{});
  Direction sum;
  for (std::size_t i = 0; i < 3; ++i) {
    sum.way[i] = std::clamp(keys.way[i] + stick.way[i], -1.0, 1.0);
    sum.turn[i] = std::clamp(keys.turn[i] + stick.turn[i], -1.0, 1.0);
  }
  return sum;
}

std::optional<Pose> Session::commanded() const {
  const Json& found = state_.member_or_null("setpoint_cp");
  if (!found.is_array() || found.size() != 7) return std::nullopt;
  std::array<double, 7> number{};
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (!found[i].is_number()) return std::nullopt;
    number[i] = found[i].get<double>();
  }
  return Pose{{number[0], number[1], number[2]}, {number[3], number[4], number[5], number[6]}};
}

Json Session::asked(Json request) {
  request["id"] = ++last_id_;
  return request;
}

void Session::change_speed(double factor) {
  speed_.tip_m_s = std::clamp(speed_.tip_m_s * factor, kMinTip_m_s, limits_.tip_m_s);
  speed_.turn_rad_s = std::clamp(speed_.turn_rad_s * factor, kMinTurn_rad_s, limits_.turn_rad_s);
}

}  // namespace liana::terminal
