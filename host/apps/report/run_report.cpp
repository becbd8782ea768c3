#include "host/apps/report/run_report.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "firmware_like/math/trig.hpp"
#include "host/apps/report/line.hpp"
#include "host/apps/report/payload_text.hpp"
#include "host/apps/report/timeline.hpp"
#include "host/apps/report/truth.hpp"
#include "host/apps/report/truth_figures.hpp"
#include "host/base/event/fault_groups.hpp"
#include "host/base/file/in_file.hpp"
#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

Json read_json(const std::string& path) {
  Json parsed = Json::parse_or_null(file::content_of(path).value_or(""));
  return parsed.is_object() ? parsed : Json::object();
}

Json object_of(const Json* pointer) { return pointer != nullptr && pointer->is_object() ? *pointer : Json::object(); }

// First and last tick of the experiment: entry of step 1, repair command (or the end, where it never came).
struct Window {
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
};

Window window_of(const Json& mission, const Json& steps, const std::vector<StateSample>& states) {
  Window window;
  window.last_tick = states.empty() ? 0 : states.back().tick;
  if (!steps.empty()) {
    window.first_tick = steps.front().value("start_tick", std::uint64_t{0});
    window.last_tick = std::max(window.first_tick, steps.back().value("end_tick", window.last_tick));
  }
  if (mission.contains("repair_tick") && mission["repair_tick"].is_number_unsigned())
    window.last_tick = mission["repair_tick"];
  return window;
}

Json steps_of(const Json& known) {
  Json steps = Json::array();
  for (const Json& step : known) {
    Json kept = Json::object();
    for (const char* key :
         {"name", "device", "held_theta", "duration_s", "slowed_s", "outcome", "reason", "ended_by", "next"}) {
      if (step.contains(key)) kept[key] = step[key];
    }
    steps.push_back(kept);
  }
  return steps;
}

const StateSample* sample_at(const std::vector<StateSample>& states, std::uint64_t tick) {
  const StateSample* best = nullptr;
  for (const StateSample& sample : states) {
    if (sample.tick <= tick) best = &sample;
  }
  return best;
}

// The rod where it really is, as the bench says; where it says nothing, as the scene has it.
std::optional<Pose> true_rod(const ReportSources& sources) {
  if (!sources.rod) return std::nullopt;
  const Json rod = read_json(sources.bench_summary_file).value("rod", Json());
  if (!rod.is_array() || rod.size() != 7) return Pose{sources.rod->position_m, sources.rod->quaternion_wxyz};
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) pose.position_m[i] = rod[i].get<double>();
  for (std::size_t i = 0; i < 4; ++i) pose.quaternion[i] = rod[i + 3].get<double>();
  return pose;
}

void add_claims(Json& report, const TruthLog& truth, const Rows& rows, const std::vector<ClearanceBounds>& claims,
                double period_s) {
  const auto claimed = verified_clearance(truth, rows.first, rows.last, claims, period_s);
  if (!claimed) return;
  report["verified_clearance_m"] = {{"min", claimed->min_m},
                                    {"truth_min", claimed->truth_min_m},
                                    {"ticks_above_truth", claimed->ticks_above_truth},
                                    {"most_above_truth_m", claimed->max_above_m}};
}

// The fault that was asked for, and when it began, as the bench says; null where it did not.
Json fault_of(const ReportSources& sources, double period_s, std::uint64_t first_tick) {
  Json fault = {{"name", sources.fault}, {"begun_s", nullptr}};
  for (const Json& each : read_json(sources.bench_summary_file).value("faults", Json::array())) {
    const Json& slot = each.member_or_null("begun_slot");
    if (!slot.is_number()) continue;
    const double begun_s = (slot.get<double>() - static_cast<double>(first_tick)) * period_s;
    if (fault["begun_s"].is_null() || begun_s < fault["begun_s"].get<double>()) fault["begun_s"] = begun_s;
  }
  return fault;
}

// In words.
std::string fault_text(const Json& fault) {
  const Json& begun_s = fault.member_or_null("begun_s");
  const std::string name = "fault " + fault.value("name", "");
  return begun_s.is_number() ? name + line(" began after %.1f s\n", begun_s.get<double>())
                             : name + " never began: what it waits for did not happen\n";
}

void add_payload(Json& report, const TruthLog& truth, const ReportSources& sources, const Window& window,
                 double period_s) {
  const PayloadSources payload{truth, sources.stages, period_s};
  const Json faults = read_json(sources.bench_summary_file).value("faults", Json::array());
  report["timeline"] = timeline_of(payload, steps_with_ticks(sources), faults, window.first_tick);
  add_payload_figures(report, payload);
  const bool is_told = !sources.stages.empty() && sources.stages.back().says_captured;
  if (is_told) report["truly_captured"] = truth.at(truth.row_count() - 1, "captured") > 0.0;
}

// Figures over the experiment, of a run that failed over all that came after it, too; why a success is none.
std::string add_truth(Json& report, const ReportSources& sources, const Window& window, double period_s) {
  const TruthLog truth = TruthLog::load(sources.truth_file);
  if (truth.row_count() == 0) return "";
  const bool success = report["outcome"] == "success";
  const std::size_t end = truth.row_of_slot(window.last_tick);
  const Rows rows{truth.row_of_slot(window.first_tick), success ? end : truth.row_count() - 1};
  const StateSample* state = sample_at(sources.states, success ? window.last_tick : UINT64_MAX);
  add_figures(report, truth, rows, true_rod(sources),
              state != nullptr ? std::optional(state->commanded_tip) : std::nullopt, sources.has_slit);
  if (truth.has("contact_force_N")) report["contacts"] = contact_count(truth, rows, period_s);
  if (sources.body_at) add_nearest(report, truth, rows, sources.body_at);
  if (sources.body_at && report.value("max_contact_force_N", 0.0) > 0.0)
    report["contact"] = contact_in(truth, rows, sources.body_at, window.first_tick, period_s);
  add_claims(report, truth, rows, sources.claims, period_s);
  if (!success) add_aftermath(report, truth, end, period_s);
  if (has_payload(truth)) add_payload(report, truth, sources, window, period_s);
  return judge(report, sources.criteria);
}

// Per bus: loads and frames; the wire's own count (embedded bus) goes before lianad's.
Json buses_of(const Json& state, const Json& stats) {
  Json buses = Json::array();
  const Json counted = stats.value("buses", Json::array());
  for (const Json& bus : state.value("buses", Json::array())) {
    Json entry = {{"name", bus.value("name", "")},
                  {"worst_load", bus.value("worst_load", 0.0)},
                  {"measured_load", bus.value("measured_load", 0.0)},
                  {"frames", bus.value("frames", 0)}};
    for (const Json& wire : counted) {
      if (wire.value("name", "") != entry["name"]) continue;
      entry["frames"] = wire.value("frames", 0);
      entry["measured_load"] = wire.value("load", 0.0);
    }
    buses.push_back(entry);
  }
  return buses;
}

std::string clearance_text(const Json& report) {
  std::string text;
  const auto add = [&](const char* key, const char* format) {
    if (report.contains(key)) text += line(format, 1e3 * report[key].get<double>());
  };
  add("min_slit_clearance_m", ", slit %.1f mm");
  add("min_box_clearance_m", ", boxes %.1f mm");
  add("min_sphere_clearance_m", ", sphere %.0f mm");
  if (report.contains("nearest")) {
    const Json& nearest = report["nearest"];
    text += line(", least %.1f mm", 1e3 * nearest["clearance_m"].get<double>()) + " to " + nearest["body"].text();
  } else if (text.empty()) {
    add("min_clearance_m", ", bodies %.1f mm");
  }
  return "clearance: " + (text.empty() ? "nothing in the scene" : text.substr(2)) + "\n";
}

// The condition that ended the step, where one did, and where `next` led.
std::string ended_by(const Json& step) {
  const std::string condition = step.value("ended_by", ""), next = step.value("next", "");
  return (condition.empty() ? "" : ": " + condition) + (next.empty() ? "" : " -> " + next);
}

// What liana-operator told, in words; empty where it told nothing.
std::string operator_text(const Json& report) {
  std::string text;
  const Json lag = report.member_or_null("hand_to_tip_lag_s").member_or_null("commanded");
  if (lag.is_object())
    text += line("tip behind the hand by %.2f s in the median", lag["median"].get<double>()) +
            line(", %.2f s at worst\n", lag["worst"].get<double>());
  if (report.contains("min_port_energy_J"))
    text += line("hand felt %.1f N at most", report["peak_hand_force_N"].get<double>()) +
            line(", energy at its port %.3f J at least\n", report["min_port_energy_J"].get<double>());
  return text;
}

// Which body was touched, by which link, how hard and when first.
std::string contact_text(const Json& contact) {
  return "touched: link " + contact["link"].dump() + " the body " + contact["body"].text() +
         line(", %.2f N", contact["force_N"].get<double>()) +
         line(", first after %.2f s", contact["first_s"].get<double>());
}

}  // namespace

// Of announced steps all but the last one made way for the next.
Json steps_with_ticks(const ReportSources& sources) {
  const Json mission = read_json(sources.mission_report_file);
  if (mission.contains("steps")) return mission["steps"];
  Json steps = Json::array();
  for (std::size_t i = 0; i < sources.announced.size(); ++i) {
    const ReportedStep& step = sources.announced[i];
    const bool last = i + 1 == sources.announced.size();
    const std::uint64_t end = last ? step.last_tick : sources.announced[i + 1].start_tick;
    steps.push_back({{"name", step.name},
                     {"device", step.device},
                     {"outcome", last ? "failed" : "success"},
                     {"start_tick", step.start_tick},
                     {"end_tick", end},
                     {"duration_s",
                      static_cast<double>(end - step.start_tick) * object_of(sources.welcome).value("period_s", 0.0)}});
    if (last) steps.back()["reason"] = "the mission runner left no report";
  }
  return steps;
}

Json make_report(const ReportSources& sources) {
  const Json mission = read_json(sources.mission_report_file);
  const Json state = object_of(sources.last_state);
  const Json welcome = object_of(sources.welcome);
  const Json steps = steps_with_ticks(sources);
  const Window window = window_of(mission, steps, sources.states);
  const std::uint64_t ticks = window.last_tick - window.first_tick;
  Json report = {{"outcome", sources.outcome.empty() ? mission.value("outcome", "failed") : sources.outcome},
                 {"robot", sources.robot},
                 {"mission", sources.mission},
                 {"mission_files", sources.mission_files},
                 {"physics", sources.physics},
                 {"seed", sources.seed},
                 {"time_mode", sources.time_mode},
                 {"config_hash", welcome.value("config_hash", "")},
                 {"duration_s", static_cast<double>(ticks) * welcome.value("period_s", 0.0)},
                 {"steps", steps_of(steps)},
                 {"ticks", ticks},
                 {"overruns", state.value("overruns", 0)},
                 {"faults", state.value("faults", Json::array())},
                 {"buses", buses_of(state, read_json(sources.bus_stats_file))}};
  // The mission may have ended before the fault came; an arm that stands in a fault has not succeeded.
  const auto fail = [&report](const std::string& reason) { report["outcome"] = "failed", report["reason"] = reason; };
  if (report["outcome"] == "success" && !report["faults"].empty()) {
    fail("a fault is latched at the end");
  } else if (report["outcome"] != "success") {
    report["reason"] = sources.reason.empty() ? mission.value("reason", "") : sources.reason;
  }
  if (!sources.fault.empty()) report["fault"] = fault_of(sources, welcome.value("period_s", 0.0), window.first_tick);
  if (sources.people.is_object()) report["operator"] = sources.people;
  if (state.contains("friction")) report["friction"] = state["friction"];
  if (sources.operator_rate_hz) report["operator_rate_hz"] = *sources.operator_rate_hz;
  if (sources.operator_samples.is_object()) report["operator_samples"] = sources.operator_samples;
  const Json of_operator = read_json(sources.operator_file);
  for (const auto& [name, figure] : of_operator.items()) report[name] = figure;
  if (!std::filesystem::exists(sources.truth_file)) return report;
  const std::string not_kept = add_truth(report, sources, window, welcome.value("period_s", 0.0));
  if (report["outcome"] == "success" && !not_kept.empty()) fail(not_kept);
  if (report["outcome"] != "success" && report.contains("contact"))
    report["reason"] = report.value("reason", "") + "; " + contact_text(report["contact"]);
  return report;
}

std::string report_text(const Json& report) {
  std::string text =
      "outcome " + report.value("outcome", "") + line(", arm time %.1f s\n", report.value("duration_s", 0.0));
  if (!report.value("reason", "").empty()) text += "reason: " + report.value("reason", "") + "\n";
  for (const event::FaultGroup& group : event::fault_groups(report.value("faults", Json::array())))
    text += "fault " + group.alarm() + ": " + group.text + "\n";
  if (report.contains("fault")) text += fault_text(report["fault"]);
  for (const Json& step : report.value("steps", Json::array())) {
    text += line("  %7.1f s  ", step.value("duration_s", 0.0)) + step.value("outcome", "") + "  " +
            step.value("name", "") + " (" + step.value("device", "none") + ")" + ended_by(step) + "\n";
  }
  if (report.contains("tip_error_m")) {
    text += line("tip error %.2f mm", 1e3 * report["tip_error_m"].get<double>()) +
            line(", %.3f deg", report["tip_attitude_error_rad"].get<double>() / kDegree) +
            line(" (open loop %.1f mm)\n", 1e3 * report.value("open_loop_tip_error_m", 0.0));
  }
  if (report.contains("cable_tension_N")) {
    text += clearance_text(report) + line("contact force %.2f N", report["max_contact_force_N"].get<double>()) +
            line(", cable tension %.1f", report["cable_tension_N"]["min"].get<double>()) +
            line(" to %.1f N", report["cable_tension_N"]["max"].get<double>()) +
            line(", at the motors %.1f at least\n", report["cable_tension_N"]["min_motor"].get<double>());
  }
  if (report.contains("contact")) {
    text += contact_text(report["contact"]) + "\n";
  }
  if (report.contains("verified_clearance_m")) {
    const Json& claimed = report["verified_clearance_m"];
    text += line("verified clearance %.1f mm", 1e3 * claimed["min"].get<double>()) +
            line(" (true %.1f mm)", 1e3 * claimed["truth_min"].get<double>()) +
            line(", above the truth in %.0f ticks\n", claimed["ticks_above_truth"].get<double>());
  }
  if (report.value("max_tip_speed_slit_m_s", 0.0) > 0.0)
    text += line("tip in the slit %.4f m/s at most\n", report["max_tip_speed_slit_m_s"].get<double>());
  if (report.contains("after_failure_s"))
    text += line("after the failure the arm moved for %.1f s", report["after_failure_s"].get<double>()) +
            (report["ends_at_rest"].get<bool>() ? "\n" : " and still moves at the end\n");
  if (report.contains("max_joint_torque_Nm")) {
    if (report.contains("min_clearance_m")) text += clearance_text(report);
    text += line("open loop %.2f mm", 1e3 * report.value("open_loop_tip_error_m", 0.0)) +
            line(", largest joint torque %.1f N m\n", report["max_joint_torque_Nm"].get<double>());
  }
  if (report.contains("friction")) {
    const Json& friction = report["friction"];
    text += line("friction mu %.3f", friction.value("mu", 0.0)) + line(" +- %.3f found", friction.value("sd", 0.0)) +
            line(", %.3f declared", friction.value("declared_mu", 0.0)) +
            line(", planned with %.3f\n", friction.value("planned_mu", 0.0));
  }
  if (report.contains("operator_rate_hz"))
    text += line("operator's samples %.0f a second at least\n", report["operator_rate_hz"].get<double>());
  text += operator_text(report);
  if (report.contains("timeline")) text += payload_text(report);
  for (const Json& bus : report.value("buses", Json::array())) {
    text += "bus " + bus.value("name", "") + line(": %.0f frames", bus.value("frames", 0.0)) +
            line(", load %.1f %%", 100.0 * bus.value("measured_load", 0.0)) +
            line(" (worst case %.1f %%)\n", 100.0 * bus.value("worst_load", 0.0));
  }
  return text;
}

}  // namespace liana::report
