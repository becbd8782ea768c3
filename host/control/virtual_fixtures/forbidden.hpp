// What walls of the scene forbid the tip: how far beyond one it is.
#pragma once

#include <optional>

#include "host/control/virtual_fixtures/placed.hpp"

namespace liana::virtual_fixtures {

// Of a tip at one place.
struct Beyond {
  double depth_m = 0.0;     // > 0: so far beyond the nearer wall; else how far it is off it, less than 0
  bool is_between = false;  // its axis is between the real walls; else it is in the room behind one of them
};

// How far a tip in the length and width of a fixture of kind `walls` is beyond them; nothing of any other tip or
// fixture. The tip's axis may come as near to a real wall as the arm is thick.
std::optional<Beyond> beyond_walls(const config::SceneFixture& fixture, double arm_radius_m,
                                   const Pose& drawing_in_base, const Vec3& tip_in_base);

}  // namespace liana::virtual_fixtures
