// Every way in which an arm that nothing touches is moved, drawn from a seed: what a watch must not take for a contact.
#pragma once

#include <cstdint>
#include <vector>

#include "arm_under_control.hpp"

namespace liana::closed_loop {

struct FreeWay {
  const char* name;
  void (*go)(ArmUnderControl& arm, std::uint64_t seed, const ArmUnderControl::Observer& look);
};

// About a minute each; the arm begins near the pose in which it was booted and stays within 0.4 m of it.
const std::vector<FreeWay>& free_ways();

}  // namespace liana::closed_loop
