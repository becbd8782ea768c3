// Which joint angles a mask names, as everything outside writes them: counted from 1.
#pragma once

#include <cstdint>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::config {

// The numbers, rising, of the thetas whose bit is set (bit 0: theta 1).
inline std::vector<int> theta_numbers(std::uint32_t mask) {
  std::vector<int> numbers;
  for (int i = 0; i < cable::kMaxTheta; ++i) {
    if (((mask >> i) & 1u) != 0) numbers.push_back(i + 1);
  }
  return numbers;
}

}  // namespace liana::config
