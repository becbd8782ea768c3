// Force control in the state message (docs/explanation/force-control.md).
#pragma once

#include "firmware_like/serial_controller.hpp"
#include "host/base/json/json.hpp"

namespace liana::server {

// `insert` and `adapter` of the state.
Json push_json(const serial::InsertStatus& push, double tick_s);
Json adapter_json(const serial::InsertStatus& push, double tick_s);

}  // namespace liana::server
