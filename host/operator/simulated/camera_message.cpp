#include "host/operator/simulated/camera_message.hpp"

#include <optional>
#include <stdexcept>
#include <string>

#include "host/base/json/json.hpp"

namespace liana::simulated {
namespace {

std::optional<Pose> pose_of(const Json& message, const char* key) {
  const auto found = message.find(key);
  if (found == nullptr || found->is_null()) return std::nullopt;
  if (!found->is_array() || found->size() != 7) {
    throw std::runtime_error(std::string("camera message: ") + key +
                             ": allowed null or [x,y,z,qw,qx,qy,qz]; see docs/reference/api.md");
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

TipObservation sighting_of(const Json& message) { return {pose_of(message, "slit"), pose_of(message, "rod")}; }

}  // namespace liana::simulated
