// All that a hand feels of a scene's fixtures now.
#pragma once

#include "host/control/virtual_fixtures/felt_planes.hpp"
#include "host/control/virtual_fixtures/guidance.hpp"

namespace liana::fixture {

// Of the fixtures that are chosen: the plane that guides, and walls and axes in whose box the tip is, where they stand
// for commands. `room_m` as feel_planes takes it.
std::vector<FeltPlane> feel_scene(const Guidance& guidance, const Vec3& tip_command_m, double room_m,
                                  double arm_radius_m, const HandMap& map, const FeelTable& feel = {});

}  // namespace liana::fixture
