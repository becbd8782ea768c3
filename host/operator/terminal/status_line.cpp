#include "host/operator/terminal/status_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "firmware_like/math/trig.hpp"
#include "host/base/event/fault_groups.hpp"
#include "host/base/json/json.hpp"
#include "host/base/text/printable.hpp"
#include "host/operator/terminal/state_text.hpp"

namespace liana::terminal {
namespace {

#if defined(__GNUC__)
__attribute__((format(printf, 1, 2)))
#endif
std::string
text_of(const char* format, ...) {
  char text[512];
  va_list words;
  va_start(words, format);
  std::vsnprintf(text, sizeof text, format, words);
  va_end(words);
  return text;
}

std::vector<double> numbers(const Json& state, const char* name) {
  std::vector<double> found;
  const Json& field = state.member_or_null(name);
  if (!field.is_array()) return found;
  for (const Json& number : field) {
    if (number.is_number()) found.push_back(number.get<double>());
  }
  return found;
}

const Json& object(const Json& state, const char* name) {
  static const Json none = Json::object();
  const Json& field = state.member_or_null(name);
  return field.is_object() ? field : none;
}

std::string owner_of(const Json& state, const std::string& name) {
  const std::string owner = state.value("owner", "");
  if (owner.empty()) return "nobody owns motion: t takes it";
  return owner == name ? "motion is yours" : "motion belongs to " + owner;
}

std::string what_next(const Json& state, const Shown& shown) {
  const std::string phase = state.value("state", "");
  if (phase == "ENABLED") return shown.is_jogging ? "moving" : state.value("at_rest", false) ? "at rest" : "";
  if (phase == "DISABLED" && !object(state, "stop").empty()) return "c clears the stop";
  if (phase == "DISABLED") return why_not_homed(state).empty() ? "n enables" : "not homed";
  if (phase == "FAULT") return "c clears what is over";
  return "wait";
}

// Of a lianad that sends nothing, nothing is claimed to be so now.
std::string head_line(const Json& state, const Shown& shown) {
  const std::string phase = state.value("state", "no state yet"), owner = owner_of(state, shown.name);
  if (shown.silent_s > 0.0)
    return text_of("%s  NOT LIVE for %.1f s  last seen: %s  %s", shown.robot.c_str(), shown.silent_s, phase.c_str(),
                   owner.c_str());
  return text_of("%s  %s  %s  %s  %.1f s", shown.robot.c_str(), phase.c_str(), owner.c_str(),
                 what_next(state, shown).c_str(), state.value("time_s", 0.0));
}

std::string tip_line(const Json& state) {
  const std::vector<double> at = numbers(state, "measured_cp"), asked = numbers(state, "setpoint_cp");
  if (at.size() != 7) return "tip         not known yet";
  std::string text = text_of("tip         x %8.4f  y %8.4f  z %8.4f m", at[0], at[1], at[2]);
  if (asked.size() == 7)
    text += text_of("   %5.1f mm from where it is asked to be",
                    1e3 * std::hypot(asked[0] - at[0], asked[1] - at[1], asked[2] - at[2]));
  return text;
}

std::string clearance_line(const Json& state) {
  const Json& clearance = object(state, "clearance");
  if (clearance.empty()) return "clearance   nothing can be claimed";
  return text_of("clearance   %.1f mm to %s (bound %.1f mm), %s", 1e3 * clearance.value("distance_m", 0.0),
                 clearance.value("body", "").c_str(), 1e3 * clearance.value("bound_m", 0.0),
                 clearance.value("level", "").c_str());
}

std::string force_line(const Json& state) {
  std::string text;
  if (const std::vector<double> tension_N = numbers(state, "tension_N"); !tension_N.empty()) {
    const auto [least, most] = std::minmax_element(tension_N.begin(), tension_N.end());
    text = text_of("cables      %.0f to %.0f N", *least, *most);
  }
  const Json& contact = object(state, "contact");
  if (const std::vector<double> push_N = numbers(contact, "force_N"); push_N.size() == 3)
    text += text_of("   push at the tip %.1f N", std::hypot(push_N[0], push_N[1], push_N[2]));
  if (contact.value("on_body", false)) text += "   touches the body";
  if (const int segment = contact.value("segment", 0); segment > 0) text += text_of(" at segment %d", segment);
  return text;
}

// What stands in the way, the gravest first.
std::vector<std::string> trouble_lines(const Json& state, const Shown& shown) {
  std::vector<std::string> lines;
  if (shown.unconfirmed_s > 0.0)
    lines.push_back(
        text_of("NOT STOPPED lianad did not confirm the stop within %.1f s, perhaps it stands still; "
                "cut the power",
                shown.unconfirmed_s));
  if (shown.silent_s > 0.0)
    lines.push_back(
        text_of("NOT LIVE    no state from lianad for %.1f s, perhaps it stands still: these lines are old; "
                "only SPACE and ESCAPE are sent",
                shown.silent_s));
  if (const Json& stop = object(state, "stop"); !stop.empty()) lines.push_back("STOPPED     by " + stopped_by(stop));
  if (const std::string left = retract_progress(state); !left.empty()) lines.push_back("RETRACT     " + left);
  if (const std::string why = why_not_homed(state); !why.empty()) lines.push_back("NOT HOMED   " + why);
  if (const Json& faults = state.member_or_null("faults"); faults.is_array()) {
    for (const event::FaultGroup& group : event::fault_groups(faults))
      lines.push_back("FAULT       " + group.alarm() + "  " + group.remedy);
  }
  if (const Json& verdict = object(state, "verdict"); verdict.value("code", 0) != 0)
    lines.push_back("REFUSED     " + verdict.value("text", "") + ": " + verdict.value("remedy", ""));
  return lines;
}

std::string limits_line(const Json& state) {
  std::string text;
  if (const Json& limits = state.member_or_null("limits"); limits.is_array()) {
    for (const Json& limit : limits) text += (text.empty() ? "" : ", ") + limit.get<std::string>();
  }
  const std::string outcome = object(state, "ik").value("outcome", "");
  return "limits      " + (text.empty() ? "none" : text) + (outcome.empty() ? "" : "   inverse kinematics " + outcome);
}

constexpr std::size_t kIndent = 12;  // of what goes on in the next line
constexpr std::size_t kMaxPieces = 3;

bool begins_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

// Where so many letters end; bytes of UTF-8 that go on a letter do not count.
std::size_t end_of_letters(const std::string& line, std::size_t letters) {
  std::size_t i = 0;
  for (; i < line.size(); ++i)
    if (begins_letter(line[i]) && letters-- == 0) break;
  return i;
}

// A line that is too long goes on in the next ones, at most three in all; broken at a space where there is one.
void append_folded(std::vector<std::string>& lines, std::string line, std::size_t columns) {
  for (std::size_t piece = 1;; ++piece) {
    const std::size_t end = end_of_letters(line, columns);
    if (end == line.size() || piece == kMaxPieces || columns < 2 * kIndent) {
      lines.push_back(line.substr(0, end));
      return;
    }
    const std::size_t space = line.rfind(' ', end);
    const std::size_t cut = space != std::string::npos && space > kIndent ? space : end;
    lines.push_back(line.substr(0, cut));
    line = std::string(kIndent, ' ') + line.substr(cut == space ? cut + 1 : cut);
  }
}

std::vector<std::string> folded(const std::vector<std::string>& lines, std::size_t columns) {
  std::vector<std::string> out;
  for (const std::string& line : lines) append_folded(out, text::printable(line, text::Lines::kOne, ' '), columns);
  return out;
}

}  // namespace

std::vector<std::string> status_lines(const Json& state, const Shown& shown, Size size) {
  std::vector<std::string> lines = folded(
      {
          head_line(state, shown),
          text_of("speed       %.0f mm/s, %.1f deg/s, along the %s axes", 1e3 * shown.speed.tip_m_s,
                  shown.speed.turn_rad_s / kDegree, shown.speed.in_tip ? "tip's" : "base's"),
          tip_line(state),
          clearance_line(state),
          force_line(state),
          limits_line(state),
      },
      size.columns);
  const std::vector<std::string> below = folded(
      {"", "said        " + shown.said, "", "w s  a d  e q   tip along x, y, z (arrows too)   f   base or tip axes",
       "j l  i k  u o   turn the tip    + -   speed    h   hold    r   retract",
       "t   take motion    n   enable   b   disable   c   clear", "SPACE or ESCAPE   emergency stop",
       "x or Ctrl-C   quit: the arm holds, motion is given back"},
      size.columns);
  std::vector<std::string> trouble = folded(trouble_lines(state, shown), size.columns);
  const std::size_t taken = lines.size() + below.size();
  const std::size_t room = size.rows > taken ? size.rows - taken : 0;
  if (trouble.size() > room) {
    trouble.resize(room);
    if (room > 0) trouble.back() = "            more: liana status";
  }
  lines.insert(lines.end(), trouble.begin(), trouble.end());
  lines.insert(lines.end(), below.begin(), below.end());
  return lines;
}

}  // namespace liana::terminal
