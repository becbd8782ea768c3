#include "host/api/server/welcome_size.hpp"

#include <stdexcept>

#include "host/base/net/socket.hpp"

namespace liana::api {

namespace {
constexpr std::size_t kOthers_bytes = 1024;  // what a welcome has beside the tables
}  // namespace

void require_fit_in_welcome(const std::string& robot_json, const std::string& scene_json,
                            const std::string& buses_json) {
  const std::size_t bytes = robot_json.size() + scene_json.size() + buses_json.size();
  const std::size_t most = kMaxPacketBytes - kOthers_bytes;
  if (bytes <= most) return;
  throw std::runtime_error("robot, scene and buses have " + std::to_string(robot_json.size()) + ", " +
                           std::to_string(scene_json.size()) + " and " + std::to_string(buses_json.size()) +
                           " bytes as JSON, together " + std::to_string(bytes) + ": allowed are " +
                           std::to_string(most) + ", which fit into one packet to a client; give the largest fewer " +
                           "points, bodies or entries, or numbers with fewer digits");
}

}  // namespace liana::api
