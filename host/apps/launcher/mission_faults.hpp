// The faults that a mission is shipped with: fault lists of the bench (docs/how-to/run-hil.md) as
// MISSION/faults/NAME.json beside the script, each an exercise of one of the mission's fault procedures.
#pragma once

#include <string>

#include "host/base/json/json_fwd.hpp"

namespace liana::launcher {

// The file of one of them. `mission` is its description (lua/liana/check.lua), null for a run without one. Throws
// BadInput with the names that there are.
std::string fault_file(const Json& mission, const std::string& name);

}  // namespace liana::launcher
