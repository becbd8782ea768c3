#include "host/apps/report/timeline.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/base/json/json.hpp"

namespace liana::report {
namespace {

struct Event {
  std::uint64_t tick = 0;
  std::string text;
};

using Events = std::vector<Event>;

std::uint64_t tick_of(const TruthLog& truth, std::size_t row) {
  return static_cast<std::uint64_t>(truth.at(row, "slot"));
}

void add_steps(Events& events, const Json& steps) {
  for (const Json& step : steps) {
    const std::string name = step.value("name", "");
    events.push_back({step.value("start_tick", std::uint64_t{0}), name + " begins"});
    if (step.contains("end_tick"))
      events.push_back({step.value("end_tick", std::uint64_t{0}), name + " ends: " + step.value("outcome", "")});
  }
}

void add_servos(Events& events, const std::vector<Stage>& stages) {
  for (const Span& servo : servos_of(stages)) {
    events.push_back({servo.begin_tick, "servo to the " + servo.target + " begins"});
    if (servo.end == "none") continue;
    const bool is_ended = servo.end == "standby";  // by something else than itself
    events.push_back({servo.end_tick, "servo to the " + servo.target + (is_ended ? " ended" : " " + servo.end)});
  }
}

void add_pushes(Events& events, const std::vector<Stage>& stages) {
  for (const Span& push : pushes_of(stages)) {
    events.push_back({push.begin_tick, "force control begins"});
    if (push.end != "none") events.push_back({push.end_tick, "force control ends: " + push.end});
  }
  double set_N = 0.0;
  for (const Stage& stage : stages) {
    if (stage.set_N != set_N)
      events.push_back({stage.tick, stage.set_N > 0.0 ? "set force " + Json(stage.set_N).dump() : "set force 0"});
    set_N = stage.set_N;
  }
}

// An event for every change of a column, by its new value; empty: none.
template <std::size_t N>
void add_changes(Events& events, const TruthLog& truth, const std::string& column,
                 const std::array<const char*, N>& names) {
  double before = truth.at(0, column);
  for (std::size_t row = 1; row < truth.row_count(); ++row) {
    const double now = truth.at(row, column);
    const auto index = static_cast<std::size_t>(now);
    if (now != before && index < N && names[index][0] != '\0') events.push_back({tick_of(truth, row), names[index]});
    before = now;
  }
}

void add_contacts(Events& events, const PayloadSources& from) {
  double touched_s = -1e9;
  for (std::size_t row = 0; row < from.truth.row_count(); ++row) {
    if (from.truth.at(row, "contact_peak_N") <= 0.0) continue;
    const double now_s = from.truth.at(row, "slot") * from.period_s;
    if (now_s - touched_s > kContactApart_s) events.push_back({tick_of(from.truth, row), "contact"});
    touched_s = now_s;
  }
}

void add_truth_events(Events& events, const PayloadSources& from) {
  const TruthLog& truth = from.truth;
  if (truth.row_count() == 0) return;
  add_contacts(events, from);
  add_changes(events, truth, "captured", std::array{"capture lost", "captured"});
  add_changes(events, truth, "latch", std::array{"latch open", "", "latch closed", "latch failed"});
  add_changes(events, truth, "lock", std::array{"lock open", "lock closing", "lock closed", "lock failed"});
  add_changes(events, truth, "holder", std::array{"", "arm has the payload", "adapter has the payload"});
}

void add_faults(Events& events, const Json& faults) {
  for (const Json& fault : faults) {
    const std::string name = "fault " + fault.value("kind", "");
    for (const auto& [key, word] : {std::pair{"begun_slot", " begins"}, std::pair{"ended_slot", " ends"}}) {
      const Json& slot = fault.member_or_null(key);
      if (slot.is_number()) events.push_back({slot.get<std::uint64_t>(), name + word});
    }
  }
}

}  // namespace

Json timeline_of(const PayloadSources& sources, const Json& steps, const Json& faults, std::uint64_t begin_tick) {
  Events events;
  add_steps(events, steps);
  add_servos(events, sources.stages);
  add_pushes(events, sources.stages);
  add_truth_events(events, sources);
  add_faults(events, faults);
  std::stable_sort(events.begin(), events.end(), [](const Event& a, const Event& b) { return a.tick < b.tick; });
  Json timeline = Json::array();
  for (const Event& event : events) {
    const double ticks = static_cast<double>(event.tick) - static_cast<double>(begin_tick);
    timeline.push_back({{"event", event.text}, {"time_s", std::round(1e6 * ticks * sources.period_s) / 1e6}});
  }
  return timeline;
}

}  // namespace liana::report
