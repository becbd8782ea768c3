#include "host/operator/terminal/state_text.hpp"

#include <cstdio>

#include "host/base/event/fault_groups.hpp"
#include "host/base/json/json.hpp"

namespace liana::terminal {
namespace {

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string head_text(const Json& state) {
  const std::string owner = state.value("owner", "");
  return state.value("state", "?") + number(", t = %.2f s", state.value("time_s", 0.0)) + ", owner " +
         (owner.empty() ? "nobody" : owner) + "\n";
}

std::string step_text(const Json& step) {
  if (!step.is_object()) return "";
  const Json& waits = step.member_or_null("waits");
  return "step " + std::to_string(step.value("index", 0)) + " " + step.value("name", "") +
         (waits.is_string() ? " waits, " + waits.text() : "") + "\n";
}

// A device that was let go for a reason no longer leads: its rate is that of its last samples.
std::string device_text(const Json& state) {
  const std::string name = state.value("device", "none"), reason = state.value("device_reason", "");
  if (name == "none" && reason.empty()) return "";
  const Json& rate = state.member_or_null("device_rate");
  const Json& rate_hz = rate.is_object() ? rate.member_or_null("hz") : rate;
  std::string text = "device " + name + ": ";
  if (!reason.empty()) text += "let go: " + reason + "; last ";
  text += rate_hz.is_number() ? number("%.1f samples/s", rate_hz.get<double>()) : "rate not measured";
  if (reason.empty()) text += state.value("device_engaged", false) ? ", engaged" : ", not engaged";
  return text + "\n";
}

std::string retract_text(const Json& state) {
  const std::string progress = retract_progress(state);
  return progress.empty() ? "" : "retract: " + progress + "\n";
}

std::string faults_text(const Json& faults) {
  std::string text;
  for (const event::FaultGroup& group : event::fault_groups(faults)) {
    text += "fault " + group.alarm() + ": " + group.text + "\n";
    if (!group.remedy.empty()) text += "  what to do: " + group.remedy + "\n";
  }
  return text;
}

std::string clearance_text(const Json& clearance) {
  if (!clearance.is_object()) return "";
  return number("clearance at least %.1f mm (", 1e3 * clearance.value("distance_m", 0.0)) +
         clearance.value("body", "") + ", link " + std::to_string(clearance.value("link", 0)) + "; " +
         clearance.value("confidence", "") + number(", bound %.1f mm; ", 1e3 * clearance.value("bound_m", 0.0)) +
         clearance.value("level", "") + ")\n";
}

}  // namespace

std::string stopped_by(const Json& stop) {
  const std::string reason = stop.value("reason", "");
  return stop.value("by", "") + (reason.empty() ? "" : ": " + reason);
}

std::string retract_progress(const Json& state) {
  const Json& retract = state.member_or_null("retract");
  if (!retract.is_object()) return "";
  const std::string phase = retract.value("phase", "");
  if (phase != "stopping" && phase != "joining" && phase != "back") return "";
  const int left = retract.value("points_left", 0), points = retract.value("points", 0);
  const double share = points > 0 ? static_cast<double>(left) / points : 0.0;
  return phase + number(", %.0f %% of the path left", 100.0 * share) + " (" + std::to_string(left) + " of " +
         std::to_string(points) + " points)";
}

std::string why_not_homed(const Json& state) {
  const Json& found = state.member_or_null("not_homed");
  if (!found.is_object() || state.value("state", "") == "BOOTING") return "";
  return found.value("text", "") + " (" + found.value("reason", "") + ")";
}

std::string state_text(const Json& state) {
  std::string text = head_text(state);
  if (const Json& stop = state.member_or_null("stop"); stop.is_object())
    text += "emergency stop by " + stopped_by(stop) + "\n";
  if (const std::string why = why_not_homed(state); !why.empty()) text += "not homed: " + why + "\n";
  text += step_text(state.member_or_null("step")) + retract_text(state) + device_text(state);
  text += faults_text(state.value("faults", Json::array()));
  if (const Json& recovery = state.member_or_null("recovery"); recovery.is_object())
    text += "lost: " + recovery.value("where", "") + "; next: " + recovery.value("next", "") +
            " (docs/how-to/a-cable-broke.md)\n";
  if (const std::string waits = state.value("enabling_waits", ""); !waits.empty())
    text += "enabling waits: " + waits + "\n";
  text += clearance_text(state.member_or_null("clearance")) + "theta (deg):";
  for (const Json& angle : state.value("measured_js_deg", Json::array())) text += number(" %.3f", angle.get<double>());
  return text + "\n";
}

}  // namespace liana::terminal
