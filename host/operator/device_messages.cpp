#include "host/operator/device_messages.hpp"

#include <cmath>
#include <stdexcept>

#include "host/json/json.hpp"

namespace liana::operator_side {
namespace {

// Rounded to what such devices resolve, which also keeps packets short.
double rounded(double value, double steps_per_unit) { return std::round(value * steps_per_unit) / steps_per_unit; }

Json pose_json(const Pose& pose) {
  Json list = Json::array();
  for (double x : pose.position_m) list.push_back(rounded(x, 1e6));
  for (double q : pose.quaternion) list.push_back(rounded(q, 1e8));
  return list;
}

Json handle_json(const VrHandle& handle) {
  return {{"valid", handle.valid}, {"trigger", handle.trigger}, {"pose", pose_json(handle.pose)}};
}

std::optional<Pose> pose_of(const Json& message, const char* key) {
  const auto found = message.find(key);
  if (found == nullptr || found->is_null()) return std::nullopt;
  if (!found->is_array() || found->size() != 7) {
    throw std::runtime_error(std::string("camera message: ") + key +
                             ": allowed null or [x,y,z,qw,qx,qy,qz]; see docs/api.md");
  }
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i) pose.position_m[i] = (*found)[i].get<double>();
  for (std::size_t i = 0; i < 4; ++i) pose.quaternion[i] = (*found)[i + 3].get<double>();
  if (!is_valid(pose))
    throw std::runtime_error(std::string("camera message: ") + key +
                             ": not a pose; allowed finite numbers and a unit quaternion");
  return pose;
}

}  // namespace

Json device_message(const std::vector<VrSample>& samples) {
  Json list = Json::array();
  for (const VrSample& sample : samples) {
    list.push_back({{"t_us", sample.t_us}, {"right", handle_json(sample.right)}, {"left", handle_json(sample.left)}});
  }
  return {{"op", "device"}, {"device", "vr"}, {"samples", std::move(list)}};
}

Json device_message(const std::vector<ControllerSample>& samples) {
  Json list = Json::array();
  for (const ControllerSample& sample : samples) {
    list.push_back({{"t_us", sample.t_us},
                    {"valid", sample.valid},
                    {"button", sample.button ? 1 : 0},
                    {"pose", pose_json(sample.pose)}});
  }
  return {{"op", "device"}, {"device", "hand"}, {"samples", std::move(list)}};
}

TipSighting sighting_of(const Json& message) { return {pose_of(message, "slit"), pose_of(message, "rod")}; }

}  // namespace liana::operator_side
