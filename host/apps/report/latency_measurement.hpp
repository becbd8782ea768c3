// A measurement of the real-time thread, as `liana latency` makes it.
#pragma once

#include "host/base/json/json.hpp"

namespace liana::report {

// What lianad measured, and how it went meanwhile.
struct LatencyMeasurement {
  Json timing;           // lianad's answer (docs/reference/api.md, `timing`)
  Json last_state;       // at the end of the measurement
  bool enabled = false;  // from before its begin to its end
  double moving = 0.0;   // share of the states that told of a moving arm, 0 to 1
};

}  // namespace liana::report
