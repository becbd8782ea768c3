// A way round obstacles when none is known: two random trees in theta, one from each end, growing towards each other
// (Kuffner and LaValle 2000), then straightened. The random numbers are a fixed sequence: same request, same way.
#pragma once

#include <atomic>
#include <cstdint>

#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

constexpr std::int32_t kExploreSteps = 3000;  // random poses drawn
constexpr std::int32_t kShortcutTries = 200;

struct ExploreRequest {
  ThetaVector from_rad{};
  ThetaVector to_rad{};
  std::uint32_t held_mask = 0;  // bit k: theta k keeps what it has at from_rad (the same as at to_rad)
  double margin_m = 0.0;
  std::uint64_t sequence = 1;  // > 0: which random numbers
};

// Corners of a free way with both ends; empty when none was found or `cancelled` was set. Both ends must be free.
Path explore(const Room& room, const ExploreRequest& request, const std::atomic<bool>* cancelled);

// The same way with corners cut where the straight piece is free.
Path shortcut(const Room& room, Path path, double margin_m, std::uint64_t sequence);

}  // namespace liana::planner
