// All that a hand feels of a scene's fixtures now.
#pragma once

#include "host/control/virtual_fixtures/guidance.hpp"
#include "host/control/virtual_fixtures/haptic_planes.hpp"

namespace liana::virtual_fixtures {

// Of the fixtures that are chosen: the plane that guides, and walls and axes in whose box the tip is, where they stand
// for commands. `room_m` as render_planes takes it.
std::vector<HapticPlane> feel_scene(const Guidance& guidance, const Vec3& tip_command_m, double room_m,
                                    double arm_radius_m, const HandMap& map, const FeelTable& feel = {});

}  // namespace liana::virtual_fixtures
