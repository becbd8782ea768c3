// What is wrong with a drive: faults that last, given from outside.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

namespace liana::bench {

struct DriveDefects {
  bool silent = false;              // acts, but sends nothing
  bool stuck = false;               // position, velocity and torque are reported as they were; the servo is well
  bool no_reports = false;          // no TPDO leaves, all else does
  std::optional<std::int8_t> mode;  // it takes 6060, stays in this mode, and follows no target
  bool twice = false;               // a second drive has the same node id: all is said twice, another place is reported
  std::uint64_t reset_us = 0;       // from an NMT reset to the boot-up message, where its dictionary is quicker
  std::uint64_t power_us = 0;       // for each transition towards Operation enabled
  std::uint64_t sdo_us = 0;         // from an SDO request to its answer, where its dictionary is quicker
  std::size_t late_cycles = 0;      // TPDOs leave so many SYNCs after they were sampled
  std::optional<std::uint8_t> pdo_length;                                 // TPDOs have so many bytes, 0..8
  double most_torque_permille = std::numeric_limits<double>::infinity();  // the motor gives no more, whatever 6072 says
};

}  // namespace liana::bench
