// Whole ticks of the controller with ideal drives, in every phase of its life.
#pragma once

#include "tests/benchmarks/meter.hpp"

namespace liana::bench {

// Counts each tick of each phase under the operation "tick", version = name of the phase; every phase has the same
// number of ticks. Throws std::runtime_error when a phase did not bring the state it is named after.
void measure_ticks(Meter& meter);

}  // namespace liana::bench
