// The source's arm as the simulation knows it, for its tests.
#pragma once

#include <utility>
#include <vector>

#include "host/model/simulation/arm_model.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::simulation {

inline ArmModel model_of(const cable::RobotParams& table) { return {table, 0.03, 0.4, 0.2, kSwingDamping_1_s}; }
inline ArmModel zhu2022_model() { return model_of(cable::zhu2022::table()); }

// Arms of many modules, the first of as many as the core serves.
inline std::vector<cable::RobotParams> long_tables() {
  std::vector<cable::RobotParams> out;
  for (const auto& [segments, modules] : {std::pair{cable::kMaxSegments, cable::kMaxModules}, {4, 16}, {8, 8}}) {
    cable::RobotParams table = cable::zhu2022::table();
    table.segment_count = segments;
    for (std::int32_t m = 0; m < segments; ++m) {
      cable::SegmentParams& segment = table.segment[static_cast<std::size_t>(m)];
      segment = cable::zhu2022::segment(modules, 3, 15.0 * m);
      segment.module_length_m = 0.02;
      segment.module_mass_kg = 0.005;
      segment.face_offset_m = 0.004;
      segment.theta_limit_rad = 10.0 * kDegree;
    }
    out.push_back(table);
  }
  return out;
}

}  // namespace liana::simulation
