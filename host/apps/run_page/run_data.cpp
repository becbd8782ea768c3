#include "host/apps/run_page/run_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "host/api/telemetry/record.hpp"
#include "host/apps/report/command_json.hpp"
#include "host/apps/run_page/columns.hpp"
#include "host/apps/run_page/deflate.hpp"
#include "host/apps/run_page/time_grid.hpp"

namespace liana::run_page {
namespace {

constexpr std::string_view kMark = "<!-- liana-run -->";
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Of the bench's truth: column of its file (a family of angles ends in _), name and unit on the page.
struct TruthColumn {
  const char* column;
  const char* name;
  const char* unit;
};
constexpr std::array<TruthColumn, 7> kTruth{{{"theta_deg_", "truth.theta_deg", "deg"},
                                             {"clearance_m", "truth.clearance_m", "m"},
                                             {"contact_force_N", "truth.contact_N", "N"},
                                             {"rod_force_N", "truth.rod_N", "N"},
                                             {"tension_min_N", "truth.tension_min_N", "N"},
                                             {"tip_speed_m_s", "truth.tip_speed_m_s", "m/s"},
                                             {"slit_depth_m", "truth.slit_depth_m", "m"}}};
// What can be computed from the angles, or is of no use on a page, is left out.
constexpr std::array<std::string_view, 16> kLeftOut{"measured_cp",
                                                    "setpoint_cp",
                                                    "node_m",
                                                    "drives.position_m",
                                                    "buses.frames",
                                                    "ik.residual_rad",
                                                    "friction.sd",
                                                    "clearance.turn_deg",
                                                    "insert.applied_force.torque_Nm",
                                                    "insert.wrist_age_s",
                                                    "adapter.age_s",
                                                    "adapter.sequence",
                                                    "servo.duration_s",
                                                    "servo.observations_used",
                                                    "servo.observations_rejected",
                                                    "torque_commanded_Nm"};

bool is_left_out(std::string_view name) {
  for (const std::string_view each : kLeftOut) {
    if (each == name) return true;
  }
  return false;
}

// A field that never had a number in the run has no columns.
void add_telemetry(const RunData& run, const TimeGrid& grid, std::vector<Column>& columns) {
  const std::vector<const std::string*> rows = records_at(grid, run.records);
  std::vector<double> values(rows.size());
  for (const telemetry::Place& place : run.layout.places) {
    if (is_left_out(place.field.path)) continue;
    const std::size_t before = columns.size();
    bool is_known = false;
    for (std::size_t i = 0; i < place.count; ++i) {
      for (std::size_t row = 0; row < rows.size(); ++row)
        values[row] = rows[row] == nullptr ? kNone : static_cast<double>(telemetry::value_of(*rows[row], place, i));
      is_known =
          is_known || std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
      columns.push_back(column_of(std::string(place.field.path), i, std::string(place.field.unit), values));
    }
    if (!is_known) columns.erase(columns.begin() + static_cast<std::ptrdiff_t>(before), columns.end());
  }
}

// Slots of the bench are ticks of lianad.
void add_truth(const report::TruthLog& truth, const std::string& column, std::size_t index, const TruthColumn& shown,
               const TimeGrid& grid, std::vector<Column>& columns) {
  std::vector<double> values;
  for (std::size_t row = 0; row < grid.rows; ++row)
    values.push_back(truth.at(truth.row_of_slot(grid.tick(row)), column));
  columns.push_back(column_of(shown.name, index, shown.unit, values));
}

void add_truth(const report::TruthLog& truth, const TimeGrid& grid, std::vector<Column>& columns) {
  for (const TruthColumn& shown : kTruth) {
    const std::string name = shown.column;
    if (!name.ends_with("_")) {
      if (truth.has(name)) add_truth(truth, name, 0, shown, grid, columns);
      continue;
    }
    for (std::size_t i = 0; truth.has(name + std::to_string(i + 1)); ++i)
      add_truth(truth, name + std::to_string(i + 1), i, shown, grid, columns);
  }
}

Json columns_json(const std::vector<Column>& columns) {
  Json list = Json::array();
  for (const Column& column : columns) list.push_back(to_json(column));
  return list;
}

std::uint64_t ticks_in_a_second(const RunData& run) {
  return static_cast<std::uint64_t>(std::lround(1.0 / run.period_s));
}

// What `now` has otherwise than `before`; null where a member is gone.
Json changed(const Json& before, const Json& now) {
  Json out = Json::object();
  for (const auto& [name, value] : now.items()) {
    if (before.member_or_null(name) != value) out[name] = value;
  }
  for (const auto& [name, value] : before.items()) {
    if (!now.contains(name)) out[name] = nullptr;
  }
  return out;
}

// Of facts the first whole, of later ones the members that are others than before. Limits act and end many times a
// second: where nothing else has changed they are told once in one.
Json facts_json(const RunData& run) {
  Json list = Json::array();
  Json before = Json::object();
  std::uint64_t next = 0;
  for (const auto& [tick, now] : run.facts) {
    const Json difference = changed(before, now);
    const bool limits_alone = difference.size() == 1 && difference.contains("limits");
    if (limits_alone && tick < next) continue;
    next = tick + ticks_in_a_second(run);
    list.push_back({{"tick", tick}, {"state", difference}});
    before = now;
  }
  return list;
}

// All that were refused, and of the others one in two seconds.
Json commands_json(const RunData& run) {
  Json list = Json::array();
  const std::uint64_t second = ticks_in_a_second(run);
  std::uint64_t next = 0;
  for (const report::CommandRecord& life : run.commands) {
    if (!life.is_refused() && life.tick < next) continue;
    if (!life.is_refused()) next = life.tick + 2 * second;
    list.push_back(report::command_json(life));
  }
  return list;
}

Json steps_json(const std::vector<Json>& events) {
  Json steps = Json::array();
  for (const Json& event : events) {
    if (event.value("kind", "") != "step" || event.at("number") == 0) continue;  // 0: the last one is over
    steps.push_back({{"index", event.at("number")}, {"name", event.at("subject")}, {"tick", event.at("tick")}});
  }
  return steps;
}

// JSON that may stand in a page: nothing in it looks like a tag.
std::string in_page(const Json& json) {
  std::string out;
  for (const char letter : json.dump(-1, Json::BadUtf8::kReplace)) {
    if (letter == '<') {
      out += "\\u003c";
    } else {
      out += letter;
    }
  }
  return out;
}

bool has_replay(const RunData& run) { return !run.core.empty() && run.ticks.ticks > 0; }

std::string packed_script(const char* id, const std::string& bytes) {
  return std::string("<script type=\"text/plain\" id=\"") + id + "\">" + base64(deflated(bytes)) + "</script>\n";
}

Json replay_json(const RunData& run) {
  if (!has_replay(run)) return nullptr;
  return {{"is_serial", run.ticks.is_serial},
          {"recorded", run.ticks.recorded},
          {"ticks", run.ticks.ticks},
          {"start_bytes", run.ticks.start.size()}};
}

std::string replay_scripts(const RunData& run) {
  if (!has_replay(run)) return "";
  return packed_script("liana-core", run.core) +
         packed_script("liana-ticks", run.ticks.start + run.ticks.sizes + run.ticks.checksums + run.ticks.inputs);
}

}  // namespace

std::string page_of(const RunData& run, const std::string& page) {
  const std::size_t mark = page.find(kMark);
  if (mark == std::string::npos) throw std::runtime_error("the page has no line " + std::string(kMark));
  const TimeGrid grid = grid_of(run.records, run.period_s);
  std::vector<Column> columns;
  add_telemetry(run, grid, columns);
  if (run.truth && run.truth->row_count() > 0) add_truth(*run.truth, grid, columns);
  const Json json{{"format", 1},
                  {"title", run.title},
                  {"robot", run.robot},
                  {"scene", run.scene},
                  {"buses", run.buses},
                  {"report", run.report},
                  {"period_s", run.period_s},
                  {"steps", steps_json(run.events)},
                  {"events", run.events},
                  {"commands", commands_json(run)},
                  {"facts", facts_json(run)},
                  {"replay", replay_json(run)},
                  {"telemetry",
                   {{"rows", grid.rows},
                    {"ticks", {{"first", grid.first}, {"every", grid.every}}},
                    {"columns", columns_json(columns)}}}};
  return page.substr(0, mark) + "<script type=\"application/json\" id=\"liana-run\">" + in_page(json) + "</script>\n" +
         replay_scripts(run) + "<script type=\"text/plain\" id=\"liana-telemetry\">" + packed(columns) + "</script>" +
         page.substr(mark + kMark.size());
}

}  // namespace liana::run_page
