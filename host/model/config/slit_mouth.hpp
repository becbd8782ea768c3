// The scene's slit as the core's DOF split wants it.
#pragma once

#include "host/model/config/config.hpp"
#include "host/model/inverse_kinematics/dof_split.hpp"

namespace liana::config {

// Room for link axes: the gap less the module's radius on either side. A scene's slit is open along its width.
inline inverse_kinematics::SlitMouth slit_mouth(const SceneSlit& slit, double module_radius_m) {
  constexpr double kOpen_m = 100.0;
  return {{slit.frame.position_m, slit.frame.quaternion_wxyz},
          slit.end_u_m - slit.mouth_u_m,
          slit.half_gap_m - module_radius_m,
          kOpen_m};
}

}  // namespace liana::config
