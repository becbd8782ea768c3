#include "host/apps/cli/check_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "host/control/verification/refusal_table.hpp"

namespace liana::cli {
namespace {

using report::CommandRecord;

// Ticks in which commands of one step were asked for.
struct Span {
  std::uint64_t first = 0;
  std::uint64_t end = std::numeric_limits<std::uint64_t>::max();
  bool contains(const CommandRecord& life) const { return life.tick >= first && life.tick < end; }
};

Span span_of(const Json& step) {
  Span span;
  return {step.value("start_tick", span.first), step.value("end_tick", span.end)};
}

// Of every limit the least that a command left of it, null where none was held against it.
Json min_margins(const std::vector<CommandRecord>& lives, const Span& span) {
  Json least = Json::object();
  for (const char* name : event::kMarginNames) least[name] = nullptr;
  for (const CommandRecord& life : lives) {
    if (!span.contains(life) || !life.simulation || !life.simulation->margins) continue;
    for (std::size_t i = 0; i < event::kMargins; ++i) {
      const double margin = (*life.simulation->margins)[i];
      Json& kept = least[event::kMarginNames[i]];
      if (std::isfinite(margin) && (kept.is_null() || margin < kept.get<double>())) kept = margin;
    }
  }
  return least;
}

std::size_t count(const std::vector<CommandRecord>& lives, const Span& span, bool (CommandRecord::*counts)() const) {
  return static_cast<std::size_t>(std::count_if(
      lives.begin(), lives.end(), [&](const CommandRecord& life) { return span.contains(life) && (life.*counts)(); }));
}

Json steps_json(const DryRun& run) {
  Json steps = Json::array();
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    const Span span = span_of(run.steps[i]);
    Json step = run.report["steps"][i];
    step["commands"] = count(run.lives, span, &CommandRecord::is_command);
    step["refused"] = count(run.lives, span, &CommandRecord::is_refused);
    step["margins"] = min_margins(run.lives, span);
    steps.push_back(step);
  }
  return steps;
}

Json step_name(const Json& steps, const CommandRecord& life) {
  for (const Json& step : steps) {
    if (span_of(step).contains(life)) return step.value("name", "");
  }
  return nullptr;
}

// A command has a code, with a name and a remedy; a request has its answer.
Json first_of(const DryRun& run, const CommandRecord& life) {
  Json out = {{"code", nullptr},
              {"name", nullptr},
              {"action", nullptr},
              {"remedy", nullptr},
              {"count", 1},
              {"step", step_name(run.steps, life)},
              {"time_s", static_cast<double>(life.tick) * run.period_s},
              {"text", life.refusal->text}};
  if (!life.is_command()) return out;
  const verification::RefusalRow& row = verification::row_of(static_cast<verification::Refusal>(life.refusal->number));
  out["code"] = life.refusal->number;
  out["name"] = row.name;
  out["action"] = life.refusal->subject;
  out["remedy"] = row.remedy;
  return out;
}

bool is_like(const Json& group, const Json& refusal) {
  return group["code"] == refusal["code"] && group["step"] == refusal["step"] &&
         (!group["code"].is_null() || group["text"] == refusal["text"]);
}

// A steering hand is refused once an interval for as long as it goes on: what is alike within a step is told once.
Json refusals_json(const DryRun& run) {
  Json groups = Json::array();
  for (const CommandRecord& life : run.lives) {
    if (!life.is_refused()) continue;
    const Json refusal = first_of(run, life);
    const auto group =
        std::find_if(groups.begin(), groups.end(), [&](const Json& each) { return is_like(each, refusal); });
    if (group == groups.end()) {
      groups.push_back(refusal);
    } else {
      (*group)["count"] = (*group)["count"].get<std::uint64_t>() + 1;
    }
  }
  return groups;
}

Json median_and_worst(std::vector<double> times_us) {
  if (times_us.empty()) return {{"median", nullptr}, {"worst", nullptr}};
  std::sort(times_us.begin(), times_us.end());
  return {{"median", times_us[(times_us.size() - 1) / 2]}, {"worst", times_us.back()}};
}

std::string line(const char* format, double value) {
  char text[128];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string margins_text(const Json& margins) {
  const std::pair<const char*, std::pair<double, const char*>> shown[] = {{"clearance_m", {1e3, "clearance %.1f mm"}},
                                                                          {"joint_deg", {1.0, "angle %.2f deg"}},
                                                                          {"rate_deg_s", {1.0, "rate %.2f deg/s"}},
                                                                          {"tension_N", {1.0, "tension %.1f N"}}};
  std::string text;
  for (const auto& [name, how] : shown) {
    if (!margins[name].is_null())
      text += (text.empty() ? "" : ", ") + line(how.second, how.first * margins[name].get<double>());
  }
  return text.empty() ? "without margins" : "leaves " + text;
}

// What the bench measured; of a serial arm, whose bench knows no bodies, what verification claimed. Null where the
// scene has none, or the arm never ran.
std::string clearance_text(const Json& report, double arm_s, bool is_serial) {
  const Json& least_m = is_serial ? report["margins"]["clearance_m"] : report["min_clearance_m"];
  if (least_m.is_null()) return arm_s > 0.0 ? "clearance: nothing in the scene\n" : "";
  return line(is_serial ? "least clearance claimed %.1f mm\n" : "least clearance %.1f mm\n",
              1e3 * least_m.get<double>());
}

std::string step_text(const Json& step) {
  std::string text = line("  %7.1f s  ", step.value("duration_s", 0.0)) + step.value("outcome", "") + "  " +
                     step.value("name", "") + " (" + step.value("device", "none") + ")\n";
  return text + line("             %.0f commands: ", step["commands"].get<double>()) + margins_text(step["margins"]) +
         "\n";
}

std::string refusal_text(const Json& refusal) {
  const bool is_command = !refusal["code"].is_null();
  std::string text = "refused" + line(", %.0f times", refusal["count"].get<double>()) +
                     line(", first at %.2f s", refusal["time_s"].get<double>());
  if (!refusal["step"].is_null()) text += " in step " + refusal["step"].text();
  text += ": ";
  if (is_command) text += line("%.0f ", refusal["code"].get<double>()) + refusal["name"].text() + ": ";
  return text + refusal["text"].text() + (is_command ? "; " + refusal["remedy"].text() : "") + "\n";
}

}  // namespace

Json check_report(const DryRun& run) {
  const Json& report = run.report;
  return {{"outcome", report["outcome"]},
          {"reason", report.member_or_null("reason")},
          {"mission", report["mission"]},
          {"robot", report["robot"]},
          {"physics", report["physics"]},
          {"seed", report["seed"]},
          {"steps", steps_json(run)},
          {"commands", count(run.lives, {}, &CommandRecord::is_command)},
          {"refused", count(run.lives, {}, &CommandRecord::is_refused)},
          {"refusals", refusals_json(run)},
          {"faults", report["faults"]},
          {"margins", min_margins(run.lives, {})},
          {"min_clearance_m", report.member_or_null("min_clearance_m")},
          {"verify_us", median_and_worst(run.verify_us)},
          {"arm_time_s", report["duration_s"]},
          {"wall_time_s", run.wall_time_s}};
}

std::string check_text(const Json& report, bool is_serial) {
  const double arm_s = report["arm_time_s"].get<double>(), wall_s = report["wall_time_s"].get<double>();
  std::string text = "outcome " + report["outcome"].text() + line(", arm time %.1f s", arm_s) +
                     line(", checked in %.1f s", wall_s) + line(" (%.1f times as fast)\n", arm_s / wall_s);
  if (!report["reason"].is_null()) text += "reason: " + report["reason"].text() + "\n";
  for (const Json& fault : report["faults"]) {
    text += line("fault %.0f ", fault.value("number", 0.0)) + fault.value("name", "") + ": " + fault.value("text", "") +
            "\n";
  }
  for (const Json& step : report["steps"]) text += step_text(step);
  for (const Json& refusal : report["refusals"]) text += refusal_text(refusal);
  text += clearance_text(report, arm_s, is_serial);
  text +=
      line("%.0f commands", report["commands"].get<double>()) + line(", %.0f refused", report["refused"].get<double>());
  const Json& times = report["verify_us"];
  if (!times["median"].is_null())
    text += line("; verification of one takes %.2f ms", 1e-3 * times["median"].get<double>()) +
            line(", %.2f ms at worst", 1e-3 * times["worst"].get<double>());
  return text + "\n";
}

}  // namespace liana::cli
