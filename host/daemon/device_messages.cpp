#include "host/daemon/device_messages.hpp"

namespace liana::daemon {

namespace {

constexpr double kPressed = 0.5;  // of trigger or button

arbiter::HandSample hand_sample(const api::Arguments& fields, const char* deadman, std::int64_t t_us) {
  arbiter::HandSample sample;
  sample.t_us = t_us;
  sample.valid = fields.flag("valid");
  sample.pressed = fields.number(deadman) >= kPressed;
  sample.pose = fields.pose("pose");
  return sample;
}

}  // namespace

arbiter::DeviceKind device_kind(const std::string& name) {
  if (name == "vr") return arbiter::DeviceKind::kVr;
  return name == "hand" ? arbiter::DeviceKind::kHand : arbiter::DeviceKind::kNone;
}

const char* device_name(arbiter::DeviceKind kind) {
  if (kind == arbiter::DeviceKind::kVr) return "vr";
  return kind == arbiter::DeviceKind::kHand ? "hand" : "none";
}

arbiter::SteerFrame steer_frame(const std::string& name) {
  if (name == "tip") return arbiter::SteerFrame::kTip;
  return name == "camera" ? arbiter::SteerFrame::kCamera : arbiter::SteerFrame::kBase;
}

const char* frame_name(arbiter::SteerFrame frame) {
  if (frame == arbiter::SteerFrame::kTip) return "tip";
  return frame == arbiter::SteerFrame::kCamera ? "camera" : "base";
}

void add_samples(const api::Arguments& message, arbiter::DeviceSteer& steer) {
  const arbiter::DeviceKind kind = device_kind(message.text("device"));
  if (kind != steer.in_use().kind) return;
  for (const api::Arguments& entry : message.entries("samples")) {
    const std::int64_t t_us = entry.integer("t_us");
    if (kind == arbiter::DeviceKind::kHand) {
      steer.add_tip_sample(hand_sample(entry, "button", t_us));
      continue;
    }
    steer.add_tip_sample(hand_sample(entry.object("right"), "trigger", t_us));
    steer.add_node_sample(hand_sample(entry.object("left"), "trigger", t_us));
  }
}

}  // namespace liana::daemon
