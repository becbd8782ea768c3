#include <cmath>
#include <optional>

#include "firmware_like/math/trig.hpp"
#include "host/api/telemetry/record.hpp"
#include "host/base/file/out_file.hpp"
#include "host/model/config/config.hpp"
#include "host/storage/archive/arm_points.hpp"
#include "host/storage/archive/export.hpp"
#include "host/storage/archive/foxglove.hpp"
#include "host/storage/archive/stretches.hpp"
#include "host/storage/recording/mcap.hpp"

namespace liana::archive {
namespace {

constexpr const char* kStateSchema = R"({"title":"state","description":"numbers of a state, docs/reference/api.md",
"type":"object","required":["tick","time_s"],"properties":{"tick":{"type":"integer"},"time_s":{"type":"number"},
"state":{"type":"string"},"measured_js_deg":{"type":"array","items":{"type":"number"}},
"setpoint_js_deg":{"type":"array","items":{"type":"number"}},"tension_N":{"type":"array","items":{"type":"number"}}}})";

Json number(float value) {
  return std::isfinite(value) ? Json(std::round(static_cast<double>(value) * 1e6) / 1e6) : Json();
}

// Of a base that feeds, the slide's way in metres.
std::vector<double> joint_values(const std::string& record, const telemetry::Layout& layout, double slide_m_rad) {
  std::vector<double> out;
  for (const telemetry::Place& place : layout.places) {
    if (place.field.path != "measured_js_deg") continue;
    for (std::size_t i = 0; i < place.count; ++i)
      out.push_back(static_cast<double>(telemetry::value_of(record, place, i)) * kDegree);
  }
  if (slide_m_rad > 0.0 && !out.empty()) out[0] *= slide_m_rad;
  return out;
}

// As the API nests them: "verdict.share" is member `share` of `verdict`.
Json state_json(const std::string& record, const telemetry::Layout& layout, const Json& facts) {
  const telemetry::Header header = telemetry::header_of(record);
  Json out{{"tick", static_cast<std::uint64_t>(header.tick)},
           {"time_s", header.time_s},
           {"state", facts.value("state", "")}};
  for (const telemetry::Place& place : layout.places) {
    Json value = Json::array();
    for (std::size_t i = 0; i < place.count; ++i) value.push_back(number(telemetry::value_of(record, place, i)));
    if (place.count == 1) value = Json(value[0]);
    const std::string path(place.field.path);
    const std::size_t dot = path.find('.');
    (dot == std::string::npos ? out[path] : out[path.substr(0, dot)][path.substr(dot + 1)]) = std::move(value);
  }
  return out;
}

class Export {
 public:
  Export(const Reader& reader, const std::string& file, double zero_s)
      : reader_(reader),
        zero_s_(zero_s),
        layout_(*reader.layout()),
        points_(reader.life(), layout_),
        scene_config_(config::parse_scene(reader.life().scene, "life of the archive")),
        file_(file, reader.life().made_by),
        scene_(channel("/scene", "foxglove.SceneUpdate")),
        tf_(channel("/tf", "foxglove.FrameTransforms")),
        joints_(channel("/joint_states", "foxglove.JointStates")),
        log_(channel("/log", "foxglove.Log")),
        state_(file_.add_channel({"/state", "json", "jsonschema", kStateSchema, "liana.State"})) {}

  void take(const std::string& record, const Json& facts) {
    const double time_s = telemetry::header_of(record).time_s;
    if (messages_ > 0 && time_s < next_s_) return;
    next_s_ = time_s + kMessage_s * 0.99;
    const double shown_s = zero_s_ + time_s;
    if (const std::vector<Vec3> points = points_.of(record); !points.empty()) {
      if (!is_scene_told_)
        write(scene_, time_s, foxglove::scene_update(shown_s, scene_config_, points, points_.radius_m()));
      is_scene_told_ = true;
      write(tf_, time_s, foxglove::frame_transforms(shown_s, points));
      write(joints_, time_s, foxglove::joint_states(shown_s, joint_values(record, layout_, points_.slide_m_rad())));
    }
    write(state_, time_s, state_json(record, layout_, facts));
  }
  void take(const event::Event& event) {
    const double time_s = static_cast<double>(event.tick) * reader_.life().period_s;
    write(log_, time_s, foxglove::log(zero_s_ + time_s, event));
  }
  std::uint64_t finish() {
    file_.finish();
    return messages_;
  }

 private:
  std::uint16_t channel(const char* topic, const char* schema) {
    return file_.add_channel({topic, "json", "jsonschema", foxglove::schema_of(schema), schema});
  }
  void write(std::uint16_t channel, double time_s, const Json& message) {
    file_.write_message(channel, static_cast<std::uint32_t>(++messages_), stamp_ns(zero_s_, time_s),
                        message.dump(-1, Json::BadUtf8::kReplace));
  }

  const Reader& reader_;
  const double zero_s_;
  const telemetry::Layout& layout_;
  const ArmPoints points_;
  const config::SceneConfig scene_config_;
  recording::McapWriter file_;
  const std::uint16_t scene_, tf_, joints_, log_, state_;
  std::uint64_t messages_ = 0;
  double next_s_ = 0.0;
  bool is_scene_told_ = false;
};

}  // namespace

std::uint64_t write_mcap(const Reader& reader, Span span, const std::string& path, double zero_s) {
  const Stretches stretches(reader, span);
  file::OutFile file(path);
  Export out(reader, file.unfinished_path(), zero_s);
  for (const event::Event& event : reader.events(span)) out.take(event);
  stretches.visit([&](const std::string& record, const Json& facts) { out.take(record, facts); });
  const std::uint64_t messages = out.finish();
  file.finish();
  return messages;
}

}  // namespace liana::archive
