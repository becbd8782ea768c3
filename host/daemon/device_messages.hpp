// Device samples from API messages.
#pragma once

#include <string>

#include "host/api/arguments.hpp"
#include "host/arbiter/device_steer.hpp"

namespace liana::daemon {

// Of "vr", "hand" or "none".
arbiter::DeviceKind device_kind(const std::string& name);
const char* device_name(arbiter::DeviceKind kind);

// Of "base", "tip" or "camera".
arbiter::SteerFrame steer_frame(const std::string& name);
const char* frame_name(arbiter::SteerFrame frame);

// Hands the samples of a `device` message to the steering; those of a device that is not in use are left out.
void add_samples(const api::Arguments& message, arbiter::DeviceSteer& steer);

}  // namespace liana::daemon
