// What one tick leaves for the recording.
#pragma once

#include "firmware_like/controller_io.hpp"

namespace liana::recording {

template <class Arm>
struct TickRecord {
  Inputs<Arm> inputs{};
  Outputs<Arm> outputs{};
};

}  // namespace liana::recording
