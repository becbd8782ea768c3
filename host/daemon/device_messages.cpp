#include "host/daemon/device_messages.hpp"

#include <vector>

#include "host/api/fields.hpp"
#include "host/api/request_error.hpp"
#include "host/json/json.hpp"

namespace liana {

namespace {

constexpr std::size_t kMaxSamples = 256;  // of one message: a quarter second at 1 kHz
constexpr double kWorkspace_m = 10.0;     // a device frame's size
constexpr double kPressed = 0.5;          // of trigger or button

HandSample hand_sample(const Json& object, const std::string& deadman, std::int64_t t_us) {
  HandSample sample;
  sample.t_us = t_us;
  sample.valid = flag_field(object, "valid");
  sample.pressed = number_field(object, deadman, 0.0, 1.0) >= kPressed;
  sample.pose = pose_field(object, "pose", kWorkspace_m);
  return sample;
}

}  // namespace

DeviceKind device_kind(const std::string& name) {
  if (name == "none") return DeviceKind::kNone;
  if (name == "vr") return DeviceKind::kVr;
  if (name == "hand") return DeviceKind::kHand;
  throw RequestError("bad_request", "device '" + name + "': allowed vr, hand, none");
}

void add_samples(const Json& message, DeviceSteer& steer) {
  const DeviceKind kind = device_kind(text_field(message, "device", 16));
  std::vector<HandSample> tip, left;
  for (const Json& entry : array_field(message, "samples", kMaxSamples)) {
    const std::int64_t t_us = integer_field(entry, "t_us", 0, 1LL << 53);
    if (kind == DeviceKind::kVr) {
      tip.push_back(hand_sample(entry.at("right"), "trigger", t_us));
      left.push_back(hand_sample(entry.at("left"), "trigger", t_us));
    } else {
      tip.push_back(hand_sample(entry, "button", t_us));
    }
  }
  if (kind != steer.in_use().kind) return;
  for (const HandSample& sample : tip) steer.add_tip_sample(sample);
  for (const HandSample& sample : left) steer.add_node_sample(sample);
}

}  // namespace liana
