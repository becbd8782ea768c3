// What a dry run found: steps with the least that their commands left of the limits, refusals with their remedies, and
// what verification cost.
#pragma once

#include <string>
#include <vector>

#include "host/apps/report/command_lives.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {

// Everything it is made of.
struct DryRun {
  Json report;  // of the run (report::make_report)
  Json steps;   // report::steps_with_ticks
  double period_s = 0.0;
  std::vector<report::CommandRecord> lives;
  std::vector<double> verify_us;  // of each command
  double wall_time_s = 0.0;       // of the whole dry run, from tables to report
};

// The answer of `liana check` (docs/reference/command-line.md).
Json check_report(const DryRun& run);

// The same for people. is_serial: the robot has a serial arm.
std::string check_text(const Json& report, bool is_serial);

}  // namespace liana::cli
