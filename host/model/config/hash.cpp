#include "host/model/config/config.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::config {

std::string config_hash(const std::string& robot_json, const std::string& scene_json, const std::string& buses_json) {
  return sha256_hex(robot_json + "\n" + scene_json + "\n" + buses_json + "\n");
}

}  // namespace liana::config
