#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "firmware_like/math/trig.hpp"
#include "host/api/telemetry/record.hpp"
#include "host/base/file/out_file.hpp"
#include "host/model/description/formats.hpp"
#include "host/storage/archive/export.hpp"
#include "host/storage/archive/foxglove.hpp"
#include "host/storage/archive/ros2_messages.hpp"
#include "host/storage/archive/stretches.hpp"
#include "host/storage/recording/mcap.hpp"

namespace liana::archive {
namespace {

constexpr double kDiagnostics_s = 1.0;  // between two states

bool are_known(const std::vector<double>& values, std::size_t count) {
  return values.size() == count && std::isfinite(values[0]);
}

Vec3 vec3(const std::vector<double>& values) { return {values[0], values[1], values[2]}; }

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

class Ros2Export {
 public:
  Ros2Export(const Reader& reader, Span span, const std::string& file, double zero_s)
      : layout_(*reader.layout()),
        tree_(description::tree_of(reader.life().robot, reader.life().buses, "life of the archive")),
        events_(reader.events(span)),
        period_s_(reader.life().period_s),
        zero_s_(zero_s),
        file_(file, reader.life().made_by, "ros2") {
    for (const telemetry::Place& place : layout_.places) places_.emplace(place.field.path, &place);
    for (const description::Link& link : tree_.links) {
      if (link.joint.kind != description::Joint::Kind::kFixed && link.joint.mimics.empty())
        leads_.push_back(&link.joint);
    }
    // Without it rosbag2 of newer distributions takes the profiles below for those of its own version.
    file_.add_metadata("rosbag2", {{"ROS_DISTRO", "humble"}});
  }

  void take(const std::string& record, const Json& facts) {
    const double time_s = telemetry::header_of(record).time_s;
    take_events_until(time_s);
    if (is_begun_ && time_s < next_s_) return;
    next_s_ = time_s + 0.99 * kMessage_s;
    if (!is_begun_) begin(time_s);
    const std::vector<double> measured_deg = values(record, "measured_js_deg");
    write_joints(record, time_s, measured_deg);
    if (!measured_deg.empty() && are_known(measured_deg, measured_deg.size())) write_frames(time_s, measured_deg);
    for (const char* topic : {"measured_cp", "setpoint_cp", "goal_cp"}) write_pose(record, time_s, topic);
    write_wrench(record, time_s);
    if (time_s < next_diagnostics_s_) return;
    next_diagnostics_s_ = time_s + 0.99 * kDiagnostics_s;
    write_state(record, time_s, facts);
  }
  std::uint64_t finish() {
    take_events_until(kLatest_s);
    file_.finish();
    return messages_;
  }

 private:
  static constexpr double kLatest_s = 1e12;

  std::vector<double> values(const std::string& record, std::string_view path) const {
    std::vector<double> out;
    const auto found = places_.find(path);
    if (found == places_.end()) return out;
    for (std::size_t i = 0; i < found->second->count; ++i)
      out.push_back(static_cast<double>(telemetry::value_of(record, *found->second, i)));
    return out;
  }
  ros2::Header header(double time_s, const char* frame) const { return {stamp_ns(zero_s_, time_s), frame}; }

  // What stays as it is comes first, and waits for whoever subscribes later.
  void begin(double time_s) {
    is_begun_ = true;
    write("/robot_description", "std_msgs/msg/String", time_s, ros2::text(description::urdf(tree_, {})), true);
    write("/tf_static", "tf2_msgs/msg/TFMessage", time_s, frames(time_s, {}, false), true);
  }

  // Of a base that feeds, its slide in metres.
  void write_joints(const std::string& record, double time_s, const std::vector<double>& measured_deg) {
    const auto state = [&](const std::vector<double>& angle_deg, bool has_effort) {
      ros2::JointState joints;
      for (const description::Joint* joint : leads_) {
        joints.names.push_back(joint->name);
        joints.positions.push_back(angle_deg[joint->theta] * kDegree * joint->per_rad);
      }
      if (const auto torque_Nm = values(record, "torque_Nm"); has_effort && are_known(torque_Nm, leads_.size()))
        joints.efforts = torque_Nm;
      return ros2::joint_state(header(time_s, "base"), joints);
    };
    constexpr const char* kType = "sensor_msgs/msg/JointState";
    if (are_known(measured_deg, leads_.size())) {
      const std::string measured = state(measured_deg, tree_.cables.empty());
      write("/joint_states", kType, time_s, measured);
      write("/measured_js", kType, time_s, measured);
    }
    const std::vector<double> setpoint_deg = values(record, "setpoint_js_deg");
    if (are_known(setpoint_deg, leads_.size())) write("/setpoint_js", kType, time_s, state(setpoint_deg, false));
  }

  std::string frames(double time_s, const std::vector<double>& values, bool moving) const {
    std::vector<ros2::Transform> transforms;
    for (std::size_t i = 1; i < tree_.links.size(); ++i) {
      const description::Link& link = tree_.links[i];
      if ((link.joint.kind != description::Joint::Kind::kFixed) != moving) continue;
      transforms.push_back(
          {tree_.links[link.parent].name, link.name, description::in_parent(link, moving ? values[i] : 0.0)});
    }
    return ros2::transforms(stamp_ns(zero_s_, time_s), transforms);
  }
  void write_frames(double time_s, std::vector<double> angle) {
    for (double& each : angle) each *= kDegree;
    write("/tf", "tf2_msgs/msg/TFMessage", time_s, frames(time_s, joint_values(tree_, angle), true));
  }

  void write_pose(const std::string& record, double time_s, const std::string& name) {
    constexpr std::size_t kNumbers = 7;
    const std::vector<double> v = values(record, name);
    if (!are_known(v, kNumbers)) return;
    const Pose pose{vec3(v), normalize({v[3], v[4], v[5], v[6]})};
    write("/" + name, "geometry_msgs/msg/PoseStamped", time_s, ros2::pose(header(time_s, "base"), pose));
  }

  // A cable arm knows a force along each axis of the base, or not; a serial one has a sensor at its tip.
  void write_wrench(const std::string& record, double time_s) {
    constexpr const char* kType = "geometry_msgs/msg/WrenchStamped";
    const std::vector<double> sensed_N = values(record, "insert.measured_wrench.force_N");
    const std::vector<double> sensed_Nm = values(record, "insert.measured_wrench.torque_Nm");
    const std::vector<double> estimated_N = values(record, "contact.force_N");
    if (are_known(sensed_N, 3) && are_known(sensed_Nm, 3)) {
      write("/measured_cf", kType, time_s, ros2::wrench(header(time_s, "tip"), vec3(sensed_N), vec3(sensed_Nm)));
    } else if (!tree_.cables.empty() &&
               std::ranges::any_of(estimated_N, [](double each) { return std::isfinite(each); })) {
      write("/measured_cf", kType, time_s, ros2::wrench(header(time_s, "base"), vec3(estimated_N), {}));
    }
  }

  void write_diagnostic(double time_s, const ros2::Diagnostic& status) {
    write("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", time_s, ros2::diagnostics(header(time_s, ""), status));
  }
  // Every number of the state that stands alone.
  void write_state(const std::string& record, double time_s, const Json& facts) {
    const std::string state = facts.value("state", "");
    ros2::Diagnostic status{static_cast<std::uint8_t>(state == "FAULT" ? 2 : 0), "liana: state", state, tree_.name, {}};
    for (const telemetry::Place& place : layout_.places) {
      const double value = static_cast<double>(telemetry::value_of(record, place, 0));
      if (place.count == 1 && std::isfinite(value)) status.values.emplace_back(place.field.path, short_text(value));
    }
    write_diagnostic(time_s, status);
  }
  void take_events_until(double time_s) {
    for (; next_event_ < events_.size(); ++next_event_) {
      const event::Event& event = events_[next_event_];
      const double event_s = static_cast<double>(event.tick) * period_s_;
      if (event_s > time_s) return;
      ros2::Diagnostic status{static_cast<std::uint8_t>(foxglove::level_of(event) - foxglove::kInfo),
                              std::string("liana: ") + event::event_kind_name(event.kind),
                              event.text,
                              event.subject,
                              {{"number", std::to_string(event.number)}}};
      for (const event::EventValue& value : event.values)
        status.values.emplace_back(value.name, short_text(value.value));
      write_diagnostic(event_s, status);
    }
  }

  void write(const std::string& topic, const char* type, double time_s, const std::string& message,
             bool is_latched = false) {
    std::uint16_t& channel = channels_[topic];
    if (channel == 0)
      channel = file_.add_channel({.topic = topic,
                                   .message_encoding = "cdr",
                                   .schema_encoding = "ros2msg",
                                   .schema = ros2::definition_of(type),
                                   .schema_name = type,
                                   .metadata = {{"offered_qos_profiles", ros2::quality_of_service(is_latched)}}});
    file_.write_message(channel, static_cast<std::uint32_t>(++messages_), stamp_ns(zero_s_, time_s), message);
  }

  const telemetry::Layout& layout_;
  const description::RobotTree tree_;
  const std::vector<event::Event> events_;
  const double period_s_, zero_s_;
  recording::McapWriter file_;
  std::map<std::string, std::uint16_t> channels_;
  std::map<std::string_view, const telemetry::Place*> places_;
  std::vector<const description::Joint*> leads_;
  std::uint64_t messages_ = 0;
  std::size_t next_event_ = 0;
  double next_s_ = 0.0, next_diagnostics_s_ = 0.0;
  bool is_begun_ = false;
};

}  // namespace

std::uint64_t write_ros2(const Reader& reader, Span span, const std::string& path, double zero_s) {
  const Stretches stretches(reader, span);
  file::OutFile file(path);
  Ros2Export out(reader, span, file.unfinished_path(), zero_s);
  stretches.visit([&](const std::string& record, const Json& facts) { out.take(record, facts); });
  const std::uint64_t messages = out.finish();
  file.finish();
  return messages;
}

}  // namespace liana::archive
