// The scene's obstacles by their numbers (clearance.hpp), whatever their kind.
#pragma once

#include <cstdint>

#include "host/model/config/config.hpp"

namespace liana::clearance {

// What `use` makes of obstacle 0 .. obstacle_count - 1.
template <class Use>
decltype(auto) with_obstacle(const config::SceneConfig& scene, std::int32_t obstacle, Use&& use) {
  std::size_t i = static_cast<std::size_t>(obstacle);
  if (i < scene.spheres.size()) return use(scene.spheres[i]);
  i -= scene.spheres.size();
  if (i < scene.boxes.size()) return use(scene.boxes[i]);
  return use(scene.convex[i - scene.boxes.size()]);
}

// Calls `use(obstacle, its number)` for all of them in order.
template <class Use>
void each_obstacle(const config::SceneConfig& scene, Use&& use) {
  std::int32_t number = 0;
  for (const config::SceneSphere& sphere : scene.spheres) use(sphere, number++);
  for (const config::SceneBox& box : scene.boxes) use(box, number++);
  for (const config::SceneConvex& body : scene.convex) use(body, number++);
}

}  // namespace liana::clearance
