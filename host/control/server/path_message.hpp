// Paths in API messages.
#pragma once

#include <optional>

#include "firmware_like/math/trig.hpp"
#include "host/api/server/arguments.hpp"
#include "host/base/json/json.hpp"
#include "host/control/arbiter/path_move.hpp"

namespace liana::server {

// SHA-256 over the canonical JSON of points_deg: the same points in the same order have the same one.
std::string path_hash(const Json& points_deg);

// null, or {hash, share}.
Json path_json(const std::optional<arbiter::PathProgress>& path);

// Of a `move_path` request.
template <class Arm>
arbiter::PathRequest<Arm> path_request(const api::Arguments& fields) {
  arbiter::PathRequest<Arm> out;
  out.rate_rad_s = kDegree * fields.number("rate_deg_s");
  out.margin_m = fields.number("margin_m");
  const Json& points_deg = fields.json()["points_deg"];
  for (const Json& entry : points_deg) {
    const auto point_deg = entry.get<std::vector<double>>();
    arbiter::Joints<Arm>& point_rad = out.points_rad.emplace_back();
    for (std::size_t i = 0; i < point_deg.size(); ++i) point_rad[i] = kDegree * point_deg[i];
  }
  out.hash = path_hash(points_deg);
  return out;
}

}  // namespace liana::server
