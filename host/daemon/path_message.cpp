#include "host/daemon/path_message.hpp"

#include "host/config/canonical.hpp"
#include "host/config/sha256.hpp"

namespace liana {

std::string path_hash(const Json& points_deg) { return sha256_hex(canonical_json(points_deg)); }

Json path_json(const std::optional<PathProgress>& path) {
  if (!path) return nullptr;
  return {{"hash", path->hash}, {"share", path->share}};
}

}  // namespace liana
