// Device samples from API messages.
#pragma once

#include <string>

#include "host/arbiter/device_steer.hpp"
#include "host/json/json_fwd.hpp"

namespace liana {

// "vr", "hand" or "none"; throws RequestError for others.
DeviceKind device_kind(const std::string& name);

// Hands the samples of a `device` message to the steering; samples of a device that is not in use are checked and left
// out. Throws RequestError and takes none of them when one is malformed.
void add_samples(const Json& message, DeviceSteer& steer);

}  // namespace liana
