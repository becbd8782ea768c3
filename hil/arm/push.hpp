// Something outside of the scene that pushes the arm.
#pragma once

#include <cstddef>

#include "hil/math/vec3.hpp"

namespace liana::bench {

// A force at the start of a link's axis, base frame; the link after the last stands for the tip.
struct Push {
  std::size_t link = 0;
  Vec3 force_N;
};

}  // namespace liana::bench
