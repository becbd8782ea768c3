#include "host/config/config.hpp"
#include "host/config/sha256.hpp"

namespace liana {

std::string config_hash(const RobotConfig& robot, const SceneConfig& scene, const BusesConfig& buses) {
  return sha256_hex(robot.canonical_json + "\n" + scene.canonical_json + "\n" + buses.canonical_json + "\n");
}

}  // namespace liana
