// Joint angles as everything outside writes them: in degrees, and counted from 1 where a mask names them.
#pragma once

#include <cstdint>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::config {

// The numbers, rising, of the thetas whose bit is set (bit 0: theta 1).
inline std::vector<int> theta_numbers(std::uint32_t mask) {
  std::vector<int> numbers;
  for (int i = 0; i < cable::kMaxTheta; ++i) {
    if (((mask >> i) & 1u) != 0) numbers.push_back(i + 1);
  }
  return numbers;
}

// Those of a named pose, say; at most kMaxTheta.
inline cable::ThetaVector theta_rad(const std::vector<double>& angles_deg) {
  cable::ThetaVector out{};
  for (std::size_t k = 0; k < angles_deg.size(); ++k) out[k] = angles_deg[k] * kDegree;
  return out;
}

}  // namespace liana::config
