// What the real-time thread publishes at the start of each command interval.
#pragma once

#include <cstdint>

#include "firmware_like/controller.hpp"

namespace liana::verification {

template <class Arm>
struct TwinSnapshot {
  explicit TwinSnapshot(const typename Arm::Table& table) : controller(table) {}

  std::uint64_t next_tick = 0;  // the tick that the copy computes next
  bool fresh = true;            // the copy has not computed any tick yet
  Controller<Arm> controller;
  Inputs<Arm> last_inputs{};
  Outputs<Arm> last_outputs{};
};

}  // namespace liana::verification
