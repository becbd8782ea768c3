// What the parser of scenes (scene.cpp) has in files of their own.
#pragma once

#include "host/model/config/config.hpp"
#include "host/model/config/field.hpp"

namespace liana::config {

constexpr double kUnitTolerance = 1e-9;
constexpr Range kPlace{-100, 100};      // metres from the base
constexpr Range kLength{0, 100, true};  // metres
constexpr Range kThickness{1e-4, 100};  // metres; of bodies, half or all of it
constexpr Range kDirection{-1 - kUnitTolerance, 1 + kUnitTolerance};

// `position_m` and `quaternion_wxyz`; other members are the caller's affair.
ScenePose read_pose(const Field& field);

// The list `fixtures`; no two have one name.
std::vector<SceneFixture> read_fixtures(const Field& list);

// What a slit has without being told: `slit_walls`, as long and wide as it is, `slit_plane`, which begins 0.2 m before
// the mouth, and with a rod `slit_approach`, the last 0.3 m of the way to it.
std::vector<SceneFixture> slit_fixtures(const std::optional<SceneSlit>& slit, const std::optional<SceneRod>& rod);

// The members `payload` and `adapter` of a scene; each needs the other.
ScenePayload read_payload(const Field& field);
ScenePose read_adapter(const Field& field);

}  // namespace liana::config
