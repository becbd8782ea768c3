#include "host/daemon/device_messages.hpp"

namespace liana {

namespace {

constexpr double kPressed = 0.5;  // of trigger or button

HandSample hand_sample(const Arguments& fields, const char* deadman, std::int64_t t_us) {
  HandSample sample;
  sample.t_us = t_us;
  sample.valid = fields.flag("valid");
  sample.pressed = fields.number(deadman) >= kPressed;
  sample.pose = fields.pose("pose");
  return sample;
}

}  // namespace

DeviceKind device_kind(const std::string& name) {
  if (name == "vr") return DeviceKind::kVr;
  return name == "hand" ? DeviceKind::kHand : DeviceKind::kNone;
}

void add_samples(const Arguments& message, DeviceSteer& steer) {
  const DeviceKind kind = device_kind(message.text("device"));
  if (kind != steer.in_use().kind) return;
  for (const Arguments& entry : message.entries("samples")) {
    const std::int64_t t_us = entry.integer("t_us");
    if (kind == DeviceKind::kHand) {
      steer.add_tip_sample(hand_sample(entry, "button", t_us));
      continue;
    }
    steer.add_tip_sample(hand_sample(entry.object("right"), "trigger", t_us));
    steer.add_node_sample(hand_sample(entry.object("left"), "trigger", t_us));
  }
}

}  // namespace liana
