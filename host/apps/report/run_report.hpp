// The report of `liana run`: what the mission says, what lianad counted, what the physics did.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/apps/report/guaranteed_clearance.hpp"
#include "host/apps/report/stages.hpp"
#include "host/apps/report/truth_figures.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"

namespace liana::report {

// What is kept of every state message.
struct StateSample {
  std::uint64_t tick = 0;
  Pose commanded_tip{};  // kinematics of the commanded joint angles
};

// A step as the mission announced it.
struct ReportedStep {
  int index = 0;
  std::string name, device;
  std::uint64_t start_tick = 0;
  std::uint64_t last_tick = 0;  // the last at which the mission was seen to own motion in this step
};

// Everything a report is made of. Files that do not exist leave their keys out.
struct ReportSources {
  std::string outcome;                  // overrides the mission's when not empty
  std::string reason;                   // beside an outcome that is not success; the mission's own where empty
  std::string robot, mission, physics;  // as they were given
  Json mission_files;                   // what the mission was made of: [{"file","sha256"}]; null: unknown
  Json people;                          // who steered it, and over what, as it was given; null: nobody
  std::uint64_t seed = 0;
  std::string fault;  // of the mission's own, that was asked for; empty: none
  std::string time_mode;
  std::string truth_file;  // of the bench
  std::string bench_summary_file;
  std::string mission_report_file;  // of liana-mission
  std::string bus_stats_file;       // of liana-bus
  std::string operator_file;        // of liana-operator
  std::vector<StateSample> states;
  std::vector<Stage> stages;               // of servo, push and adapter, as states told them
  std::vector<ClearanceBounds> claims;     // of lianad, as its states told them
  std::vector<ReportedStep> announced;     // stands in for the steps of a mission runner that left no report
  std::optional<double> operator_rate_hz;  // samples of the operator's device in the slowest second
  Json operator_samples;             // how far apart, and how old in commands (host/apps/launcher/sample_monitor.hpp)
  const Json* welcome = nullptr;     // of lianad
  const Json* last_state = nullptr;  // of lianad
  std::optional<config::ScenePose> rod;  // as the scene has it; none: it has none
  bool has_slit = false;                 // the scene has one; else its boxes are called boxes
  BodyAt body_at;                        // empty: no body is named
  Criteria criteria;                     // that a success has to keep, too
};

// The steps as the mission reported them, with start_tick and end_tick; or else as it announced them.
Json steps_with_ticks(const ReportSources& sources);

// The report with the keys of docs/reference/command-line.md.
Json make_report(const ReportSources& sources);

// A few lines for people.
std::string report_text(const Json& report);

}  // namespace liana::report
