#include "host/apps/cli/session_report.hpp"

#include <cstdio>

#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/start_pose.hpp"
#include "host/base/file/in_file.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/field.hpp"

namespace liana::cli {
namespace {

report::Criteria criteria(const std::string& robot_file, const std::string& physics) {
  return report::criteria_of(Json::parse_or_null(file::content_of(robot_file).value_or("")), physics);
}

report::BodyAt body_at(const launcher::RunOptions& options, const launcher::SystemLayout& plan) {
  const config::RobotConfig robot =
      config::parse_robot(config::read_text_file(plan.file("robot.json")), plan.robot, options.physics, plan.buses);
  return [robot, scene = plan.scene](const std::vector<double>& theta_deg) {
    return launcher::nearest_body(robot, scene, theta_deg);
  };
}

Json people_of(const launcher::OperatorChoice& people) {
  const auto given = [](const std::string& word) { return word.empty() ? Json() : Json(word); };
  return {{"who", people.who.empty() ? "recorded" : people.who},
          {"delay_s", given(people.delay)},
          {"feedback", given(people.feedback)},
          {"passivity", given(people.passivity)},
          {"fixtures", given(people.fixtures)},
          {"temper", given(people.temper)}};
}

}  // namespace

report::ReportSources report_sources(const launcher::RunOptions& options, const launcher::SystemLayout& plan,
                                     const launcher::RunSession& session, const launcher::RunResult& end) {
  report::ReportSources sources;
  sources.robot = plan.robot;
  sources.mission = options.mission;
  sources.physics = options.physics;
  sources.seed = options.seed;
  sources.fault = options.fault;
  sources.outcome = end.outcome;
  sources.reason = end.message.substr(0, end.message.find('\n'));
  sources.time_mode = plan.time_mode;
  sources.truth_file = plan.file("truth.bin");
  sources.bench_summary_file = plan.file("bench_summary.json");
  sources.mission_report_file = plan.file("mission.json");
  sources.operator_file = plan.operator_file();
  sources.bus_stats_file = plan.file("bus_stats.json");
  sources.states = session.states();
  sources.stages = session.stages();
  sources.claims = session.claims();
  sources.announced = session.announced();
  sources.operator_rate_hz = session.samples().slowest_hz();
  sources.operator_samples = session.samples().json();
  sources.welcome = &session.welcome();
  sources.last_state = &session.last_state();
  if (plan.scene.rod) sources.rod = plan.scene.rod->pose;
  sources.has_slit = plan.scene.slit.has_value();
  for (const Json& file : plan.mission.value("files", Json::array()))
    sources.mission_files.push_back({{"file", file.at("file")}, {"sha256", file.at("sha256")}});
  if (!plan.is_serial) {
    sources.body_at = body_at(options, plan);
    sources.people = people_of(options.people);
  }
  sources.criteria =
      criteria(plan.file("robot.json"), options.true_physics.empty() ? options.physics : options.true_physics);
  return sources;
}

bool write_report(const std::string& path, const Json& report) {
  try {
    launcher::write_output(path, report.dump(1) + "\n");
    return true;
  } catch (const std::runtime_error& error) {
    std::fprintf(stderr, "liana: the report is lost: %s\n", error.what());
    return false;
  }
}

}  // namespace liana::cli
