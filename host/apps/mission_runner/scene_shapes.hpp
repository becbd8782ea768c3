// Shapes of a scene that come from files.
#pragma once

#include <string>

#include "host/base/json/json_fwd.hpp"

namespace liana::mission_runner {

// Puts the corners of the file's hull, metres in the base frame, in the place of `stl`, `unit_m`, `position_m` and
// `quaternion_wxyz` of every convex body that has `stl`; all other fields are left to host/model/config. Files stand in
// `folder`. Throws std::runtime_error "file: field: ..." with `display` for the file.
void read_shape_files(Json& scene, const std::string& folder, const std::string& display);

}  // namespace liana::mission_runner
