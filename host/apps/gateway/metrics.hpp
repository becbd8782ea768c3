// The state in the text format of Prometheus, version 0.0.4 (docs/reference/console-protocol.md#metrics).
#pragma once

#include <cstddef>
#include <string>

#include "host/base/json/json_fwd.hpp"

namespace liana::gateway {

constexpr const char* kMetricsType = "text/plain; version=0.0.4; charset=utf-8";

// `state`: the newest of lianad, null while there is none; `clients`: consoles that have said hello. Numbers that the
// state does not have are left out.
std::string metrics_text(const Json& state, std::size_t clients);

}  // namespace liana::gateway
