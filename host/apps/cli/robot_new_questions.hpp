// What `liana robot new` asks: the one place of its questions, their usual values and what is allowed. --help, the
// prompts and the refusals read it here.
#pragma once

#include <string>

#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::cli {

struct NumberQuestion {
  const char *option, *question, *unit;
  double usual, least, most;
};
struct WholeQuestion {
  const char *option, *question;
  int usual, least, most;
};

constexpr WholeQuestion kAskSegments{"--segments", "segments that bend by themselves", 3, 1, cable::kMaxSegments};
constexpr WholeQuestion kAskModules{"--modules", "universal joints in each segment", 6, 1, cable::kMaxModules};
constexpr WholeQuestion kAskCables{"--cables", "cables that end in each segment", 3, 3, 5};
constexpr NumberQuestion kAskLength{"--module-length", "from one joint to the next", "m", 0.08, 0.001, 1.0};
// The usual radius goes with the length of a module and the number of holes.
constexpr NumberQuestion kAskRadius{"--radius", "radius of the discs", "m", 0.025, 0.0005, 0.15};
constexpr NumberQuestion kAskLimit{"--theta-limit", "most that a joint turns about each axis", "deg", 15.0, 1.0, 45.0};

// As --help has them: "from one joint to the next, 0.001 to 1 m".
std::string about(const NumberQuestion& asked);
std::string about(const WholeQuestion& asked);

}  // namespace liana::cli
