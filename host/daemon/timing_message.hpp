// The answer to a `timing` request (docs/api.md).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "host/daemon/latency_histogram.hpp"
#include "host/daemon/link.hpp"

namespace liana {

// `overruns`: those of the same time as the counts. At most 64 KiB as text up to 9 999 999 ticks in every bucket.
nlohmann::json timing_message(const LatencyCounts& wakeup, const LatencyCounts& tick, const Overruns& overruns);

}  // namespace liana
