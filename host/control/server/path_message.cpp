#include "host/control/server/path_message.hpp"

#include "host/model/config/canonical.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::server {

std::string path_hash(const Json& points_deg) { return config::sha256_hex(config::canonical_json(points_deg)); }

Json path_json(const std::optional<arbiter::PathProgress>& path) {
  if (!path) return nullptr;
  return {{"hash", path->hash}, {"share", path->share}};
}

}  // namespace liana::server
