// Force control in the state message (docs/explanation/force-control.md).
#pragma once

#include "firmware_like/serial_controller.hpp"
#include "host/base/json/json.hpp"

namespace liana::server {

// `push`, `adapter` and `payload` of the state.
Json push_json(const serial::InsertStatus& push, double tick_s);
Json payload_json(const serial::LinkMass& payload_at_tip);
Json adapter_json(const serial::InsertStatus& push, double tick_s);

}  // namespace liana::server
