// How a payload's installation went, by the bench's truth (docs/reference/command-line.md, "A payload's installation").
#pragma once

#include <optional>
#include <vector>

#include "host/apps/report/stages.hpp"
#include "host/apps/report/truth.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::report {

// Where contact counts as gone: less than this for kUnloaded_s on end. The source's 5 N
// (docs/explanation/force-control.md).
constexpr double kUnloaded_N = 5.0;
constexpr double kUnloaded_s = 1.0;
// What the servo has to come within (requirement B28).
constexpr double kSettled_m = 0.001;
constexpr double kSettled_deg = 0.5;
// Share of `force_N` at which the force has risen, and what a force is the mean over, so that an impact does
// not count for what is held.
constexpr double kRisen = 0.95;
constexpr double kForceMean_s = 0.5;

struct PayloadSources {
  const TruthLog& truth;
  const std::vector<Stage>& stages;
  double period_s = 0.0;
};

// Whether the truth is of a bench with payload and adapter.
bool has_payload(const TruthLog& truth);

// Adds every figure of an installation to the report, null where its stage was not reached: of the last servo to the
// adapter that ended by itself, and of the last push.
void add_payload_figures(Json& report, const PayloadSources& sources);

}  // namespace liana::report
