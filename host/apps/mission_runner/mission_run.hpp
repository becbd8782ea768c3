// One mission against lianad: states in, commands out, until the mission is over.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "host/apps/mission_runner/script.hpp"
#include "host/base/json/json.hpp"

namespace liana::mission_runner {

// What `liana-mission run` was asked to do.
struct MissionOptions {
  std::string api;      // socket of lianad
  std::string mission;  // name or file
  LuaFolders lua_folders;
  std::string report_file;  // empty = none
  bool lockstep = false;
  bool rehearsal = false;  // nobody is there: a step is confirmed at once, and what would wait for people ends
  bool progress = false;   // one line per step begin and end
  bool json = false;       // progress and the report as JSON lines on standard output
};

// Exit codes of the mission runner.
constexpr int kExitSuccess = 0;
constexpr int kExitNotSuccess = 1;  // refused, aborted or failed, its process killed: see the report
constexpr int kExitBadInput = 2;

// Runs the mission and returns the exit code; the report is written whatever happens short of the death of this
// process.
int run_mission(const MissionOptions& options, Activity& activity);

// A report that grows step by step, and is there for whoever watches this process as JSON at any time.
class GrowingReport {
 public:
  explicit GrowingReport(Activity& activity) : activity_(activity) {}

  // The report without those steps, `steps_before` many, that stay as they were told. Cost: that of what is told.
  void take(Json news);
  Json whole() const;

 private:
  Activity& activity_;
  Json head_ = Json::object();  // all but the steps
  Json::Array steps_;
  std::vector<std::size_t> ends_;  // of each step's text
  bool is_full_ = false;           // what came last has no room: the text stays as it was
};

// Writes a report file: {"mission","outcome","reason","steps","duration_s",...}; throws std::runtime_error.
void write_report(const std::string& path, const std::string& report_json);

// The last report in `activity`, or a new one, ended as failed for `reason`.
std::string failed_report(const Activity& activity, const std::string& mission, const std::string& reason);

}  // namespace liana::mission_runner
