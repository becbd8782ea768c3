// Camera pictures as API messages (docs/reference/api.md).
#pragma once

#include "host/base/json/json_fwd.hpp"
#include "host/operator/simulated/slit_view.hpp"

namespace liana::simulated {

// Picture in a `camera` message; throws std::runtime_error when a pose is neither null nor seven numbers with a unit
// quaternion.
TipObservation sighting_of(const Json& message);

}  // namespace liana::simulated
