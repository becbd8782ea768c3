// What is wrong with a drive: faults that last, given from outside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace liana::bench {

struct DriveDefects {
  bool silent = false;                     // acts, but sends nothing
  bool stuck = false;                      // position, velocity and torque are reported as they were; the servo is well
  std::size_t late_cycles = 0;             // TPDOs leave so many SYNCs after they were sampled
  std::optional<std::uint8_t> pdo_length;  // TPDOs have so many bytes, 0..8
  double most_torque_permille = std::numeric_limits<double>::infinity();  // the motor gives no more, whatever 6072 says
};

}  // namespace liana::bench
