#include "host/storage/recording/state_recording.hpp"

#include "host/base/event/event_json.hpp"
#include "host/storage/recording/build_id.hpp"

namespace liana::recording {

namespace {

constexpr const char* kStateSchema = R"({"title":"state","description":"docs/reference/api.md, State","type":"object",
"required":["tick","time_s","state"],"properties":{
"tick":{"type":"integer"},"time_s":{"type":"number"},"state":{"type":"string"},"stop_category":{"type":"string"},
"is_homed":{"type":"boolean"},"is_busy":{"type":"boolean"},"at_rest":{"type":"boolean"},"retracted":{"type":"boolean"},
"owner":{"type":"string"},"device":{"type":"string"},"step":{"type":"string"},"overruns":{"type":"integer"},
"measured_js_deg":{"type":"array","items":{"type":"number"}},"setpoint_js_deg":{"type":"array","items":{"type":"number"}},
"measured_cp":{"type":"array","items":{"type":"number"},"description":"x y z [m], quaternion w x y z, base frame"},
"setpoint_cp":{"type":"array","items":{"type":"number"}},"goal_cp":{"type":"array","items":{"type":"number"}},
"tension_N":{"type":"array","items":{"type":"number"}},
"node_m":{"type":"array","items":{"type":"array","items":{"type":"number"}}},
"clearance":{"type":["object","null"],"description":"clearance bound; docs/explanation/verification.md","properties":{
"distance_m":{"type":"number"},"bound_m":{"type":"number"},"body":{"type":"string"},"link":{"type":"integer"},
"where_m":{"type":"array","items":{"type":"number"}},"confidence":{"type":"string"},"observation_age_s":{"type":["number","null"]},
"camera":{"type":"string"},"level":{"type":"string"},"shift_m":{"type":"array","items":{"type":"number"}},
"turn_deg":{"type":"array","items":{"type":"number"}}}},
"limits":{"type":"array","items":{"type":"string"}},
"faults":{"type":"array","items":{"type":"object","properties":{"number":{"type":"integer"},"name":{"type":"string"},
"index":{"type":"integer"},"detail":{"type":"integer"},"tick":{"type":"integer"},"text":{"type":"string"},
"where":{"type":"string"},
"remedy":{"type":"string"}}}},
"drives":{"type":"array","items":{"type":"object","properties":{"node":{"type":"integer"},"state":{"type":"string"},
"position_m":{"type":"number"},"tension_N":{"type":"number"}}}},
"buses":{"type":"array","items":{"type":"object","properties":{"name":{"type":"string"},"frames":{"type":"integer"},
"errors":{"type":"integer"},"state":{"type":"string"},"lost":{"type":"boolean"},"measured_load":{"type":"number"}}}}}})";

constexpr const char* kVerdictSchema = R"({"title":"verdict","description":"what verification said of a setpoint",
"type":"object","required":["tick","sequence","released"],"properties":{"tick":{"type":"integer"},
"sequence":{"type":"integer"},"released":{"type":"boolean"},"code":{"type":"integer"},"text":{"type":"string"},
"margin":{"type":"number"},"twin_js_deg":{"type":"array","items":{"type":"number"}}}})";

}  // namespace

StateRecording::StateRecording(const std::string& directory, double period_s)
    : file_(directory + "/" + kStateFile, "liana " + build_id()),
      period_s_(period_s),
      state_(file_.add_channel({"state", "json", "jsonschema", kStateSchema})),
      event_(file_.add_channel({"event", "json", "jsonschema", event::kEventSchema})),
      verdict_(file_.add_channel({"verdict", "json", "jsonschema", kVerdictSchema})) {}

void StateRecording::write(std::uint16_t channel, std::uint64_t tick, std::string_view text) {
  const auto time_ns = static_cast<std::uint64_t>(static_cast<double>(tick) * period_s_ * 1e9);
  file_.write_message(channel, static_cast<std::uint32_t>(tick), time_ns, text);
}

void StateRecording::take(std::string_view text, const Json& state) {
  const std::uint64_t tick = state.at("tick");
  write(state_, tick, text);
  if (state.contains("verdict")) take_verdict(tick, state.at("verdict"));
}

void StateRecording::take_event(std::string_view text, const Json& event) {
  if (event.value("op", "") == "events_lost") {
    events_lost_ += event.at("count").get<std::uint64_t>();
    return;
  }
  write(event_, event.at("tick"), text);
  ++events_;
}

void StateRecording::take_verdict(std::uint64_t tick, const Json& verdict) {
  const bool is_none = !verdict.value("released", false) && verdict.value("text", "").empty();
  std::string text = verdict.dump();
  if (is_none || text == verdict_seen_) return;
  Json with_tick = verdict;
  verdict_seen_ = std::move(text);
  with_tick["tick"] = tick;
  write(verdict_, tick, with_tick.dump());
}

void StateRecording::finish() {
  file_.add_metadata("end", {{"events", std::to_string(events_)}, {"events_lost", std::to_string(events_lost_)}});
  file_.finish();
}

}  // namespace liana::recording
