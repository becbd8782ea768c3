#include "host/daemon/path_message.hpp"

#include "host/config/canonical.hpp"
#include "host/config/sha256.hpp"

namespace liana::daemon {

std::string path_hash(const Json& points_deg) { return config::sha256_hex(config::canonical_json(points_deg)); }

Json path_json(const std::optional<arbiter::PathProgress>& path) {
  if (!path) return nullptr;
  return {{"hash", path->hash}, {"share", path->share}};
}

}  // namespace liana::daemon
