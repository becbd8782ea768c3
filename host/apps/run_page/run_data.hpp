// What the page of a run shows, and the page itself (docs/getting-started/tour-of-the-console.md).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/api/telemetry/layout.hpp"
#include "host/apps/report/command_lives.hpp"
#include "host/apps/report/truth.hpp"
#include "host/apps/run_page/recorded_ticks.hpp"
#include "host/base/json/json.hpp"

namespace liana::run_page {

struct RunData {
  std::string title;
  Json robot, scene, buses;
  Json report;  // null: the run has left none
  double period_s = 0.0;
  telemetry::Layout layout;
  std::vector<std::string> records;                   // in the order of their ticks
  std::vector<std::pair<std::uint64_t, Json>> facts;  // from which tick on, in order
  std::vector<Json> events;                           // as the API tells them, in order
  std::vector<report::CommandRecord> commands;
  std::optional<report::TruthLog> truth;  // of the bench
  RecordedTicks ticks;
  std::string core;  // what replays them, as WebAssembly; empty: not built, and the page holds no ticks
};

// The page: `page` with its line `<!-- liana-run -->` replaced by the run. Numbers are shown 25 times a second of arm
// time, fewer in a run of more than 20 minutes; of released commands one in two seconds. Throws std::runtime_error when
// the page has no such line.
std::string page_of(const RunData& run, const std::string& page);

}  // namespace liana::run_page
