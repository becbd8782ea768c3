#include "host/apps/ground/execution.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/api/server/request_table.hpp"
#include "host/base/event/event.hpp"

namespace liana::ground {
namespace {

constexpr unsigned kSettled = 2;  // states after the answer, from which on `is_busy` is about this request
constexpr double kNear_deg = 0.01, kNear_m = 1e-3;

std::uint32_t whole_of(const Json& value, double most) {
  const double number = value.is_number() ? value.get<double>() : 0.0;
  return static_cast<std::uint32_t>(std::clamp(number, 0.0, most));
}

// The ending that a code of lianad's tells; without one it is no success for that.
Ending caused_by(const Json& code, const Json& detail, std::string text) {
  constexpr double kMaxCode = 65534.0, kMaxDetail = 4294967294.0;
  const auto number = static_cast<std::uint16_t>(whole_of(code, kMaxCode));
  if (number == 0) return failed(Failure::kNotReached);
  return {number, whole_of(detail, kMaxDetail), std::move(text)};
}

std::string text_of(const Json& object, const char* key) {
  const Json& value = object.member_or_null(key);
  return value.is_string() ? value.text() : "";
}

bool is_true(const Json& state, const char* key) { return state.member_or_null(key) == true; }

bool is_near(const Json& wanted, const Json& is, std::size_t count, double tolerance) {
  if (!wanted.is_array() || !is.is_array() || std::min(wanted.size(), is.size()) < count) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (!wanted[i].is_number() || !is[i].is_number()) return false;
    if (std::abs(wanted[i].get<double>() - is[i].get<double>()) > tolerance) return false;
  }
  return true;
}

// Whether the arm is where the request wants it; a hold wants no place.
bool has_arrived(const Json& request, const Json& state) {
  constexpr std::size_t kPlace = 3;  // of a pose
  if (const Json* goal = request.find("goal_deg"))
    return is_near(*goal, state.member_or_null("setpoint_js_deg"), goal->size(), kNear_deg);
  if (const Json* goal = request.find("goal"))
    return is_near(*goal, state.member_or_null("setpoint_cp"), kPlace, kNear_m);
  return true;
}

std::optional<Ending> when(bool done) { return done ? std::optional(Ending()) : std::nullopt; }

std::optional<Ending> fault_in(const Json& state) {
  const Json& faults = state.member_or_null("faults");
  if (!faults.is_array() || faults.empty()) return std::nullopt;
  return caused_by(faults[0].member_or_null("number"), Json(), text_of(faults[0], "text"));
}

// What ends every motion, its own goal apart.
std::optional<Ending> broken_off(const Execution& execution, const Json& state) {
  const Json& refused = state.member_or_null("refused_motions");
  const Json& verdict = state.member_or_null("verdict");
  if (refused.is_number() && refused.get<double>() > static_cast<double>(execution.refused_motions))
    return caused_by(verdict.member_or_null("code"), verdict.member_or_null("sequence"), text_of(verdict, "text"));
  if (!state.member_or_null("stop").is_null()) return failed(Failure::kStopped);
  if (text_of(state, "state") == "FAULT") return fault_in(state).value_or(failed(Failure::kNotReached));
  if (text_of(state, "owner") != kClientName) return failed(Failure::kNotOwner);
  return std::nullopt;
}

std::optional<Ending> motion(const Execution& execution, const Json& state) {
  if (auto end = broken_off(execution, state)) return end;
  if (execution.states < kSettled || is_true(state, "is_busy") || !is_true(state, "at_rest")) return std::nullopt;
  return has_arrived(execution.request, state) ? Ending() : failed(Failure::kNotReached);
}

std::optional<Ending> retracted(const Execution& execution, const Json& state) {
  if (auto end = broken_off(execution, state)) return end;
  const std::string phase = text_of(state.member_or_null("retract"), "phase");
  if (execution.states < kSettled || (phase != "done" && phase != "ended")) return std::nullopt;
  return phase == "done" ? Ending() : failed(Failure::kNotReached);
}

std::optional<Ending> enabled(const Execution& execution, const Json& state) {
  if (!state.member_or_null("stop").is_null()) return failed(Failure::kStopped);
  const std::string name = text_of(state, "state");
  if (name == "FAULT") return fault_in(state).value_or(failed(Failure::kNotReached));
  if (name == "DISABLED" && execution.states > kSettled) return failed(Failure::kNotReached);
  return when(name == "ENABLED" && is_true(state, "at_rest"));
}

std::optional<Ending> cleared(const Execution& execution, const Json& state) {
  if (execution.states < kSettled) return std::nullopt;
  if (auto fault = fault_in(state)) return fault;
  return when(state.member_or_null("stop").is_null());
}

std::optional<Ending> tool(const Execution& execution, const Json& state) {
  const std::string phase = text_of(state.member_or_null("tool"), "phase");
  if (phase == "failed" && execution.states >= kSettled) return failed(Failure::kNotReached);
  return when(phase == "done" && execution.states >= kSettled);
}

}  // namespace

Ending failed(Failure failure, std::uint32_t detail) {
  return {static_cast<std::uint16_t>(failure), detail, std::string(meaning_of(failure))};
}

Ending refused(const Json& answer) {
  const auto code = static_cast<std::uint16_t>(event::refusal_event(text_of(answer, "code")));
  const auto other = static_cast<std::uint16_t>(Failure::kRefused);
  return {code == 0 ? other : code, 0, text_of(answer, "message")};
}

std::optional<Ending> judge(const Execution& execution, const Json& state) {
  const std::string name = text_of(state, "state");
  switch (execution.row->completes) {
    case Completes::kAnswer:
      return Ending();
    case Completes::kMotion:
      return motion(execution, state);
    case Completes::kEnabled:
      return enabled(execution, state);
    case Completes::kDisabled:
      return when(name == "DISABLED" || name == "FAULT");
    case Completes::kCleared:
      return cleared(execution, state);
    case Completes::kHomed:
      return when(is_true(state, "is_homed"));
    case Completes::kRetracted:
      return retracted(execution, state);
    case Completes::kStopped:
      return when(!state.member_or_null("stop").is_null() && name != "ENABLED" && name != "STOPPING" &&
                  name != "ENABLING");
    case Completes::kTool:
      return tool(execution, state);
  }
  return std::nullopt;
}

bool replaces_motion(const Execution& execution) {
  return api::find_request(execution.row->op)->motion == api::Motion::kReplaces;
}

bool is_motion(const Execution& execution) {
  return execution.row->completes == Completes::kMotion || execution.row->completes == Completes::kRetracted;
}

}  // namespace liana::ground
