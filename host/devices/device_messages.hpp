// Device samples and camera pictures as API messages (docs/api.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "host/devices/samples.hpp"
#include "host/devices/slit_view.hpp"

namespace liana {

// `device` messages of one packet each.
nlohmann::json device_message(const std::vector<VrSample>& samples);
nlohmann::json device_message(const std::vector<ControllerSample>& samples);

// Picture in a `camera` message; throws std::runtime_error when a pose is neither null nor seven numbers with a unit quaternion.
TipSighting sighting_of(const nlohmann::json& message);

}  // namespace liana
