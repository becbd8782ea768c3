#include <cstdio>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/force_session.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/system_layout.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/apps/report/force_readings.hpp"

namespace liana::cli {
namespace {

constexpr std::int64_t kMaxConfigurations = 1000, kMaxPushes = 100;

config::RobotConfig robot_of(const ForceOptions& options) {
  const std::string text = launcher::evaluate_table("robot", options.robot);
  if (launcher::checked([&] { return config::robot_kind(text, options.robot); }) == "serial")
    throw launcher::BadInput("--robot: '" + options.robot +
                             "': has a serial arm, which estimates no forces: allowed a cable arm");
  const launcher::TableText table = launcher::buses_of(options.robot, text, "");
  const config::BusesConfig buses = launcher::checked([&] { return config::parse_buses(table.json, table.name); });
  return launcher::checked([&] { return config::parse_robot(text, options.robot, options.physics, buses); });
}

// One configuration with the programs that it takes, of which nothing is left behind.
void run(const ForceOptions& options, const config::RobotConfig& robot, const launcher::ForcePlan& plan,
         const launcher::InterruptGuard& interrupts, report::ForceReadings& all) {
  const std::string folder = launcher::temporary_directory();
  launcher::RunOptions run;
  run.robot = options.robot;
  run.scene = "none";
  run.physics = options.physics;
  run.start_pose = plan.start_pose;
  run.faults = folder + "/pushes.json";
  run.seed = options.seed + plan.number;
  launcher::write_output(run.faults, launcher::push_list(plan, robot.table.tick_s));
  const launcher::SystemLayout layout = launcher::make_layout(run);
  try {
    launcher::LockstepSession session(layout, interrupts, "liana force", "the self-test is not complete");
    launcher::feel_forces(session, plan, robot, all);
  } catch (...) {
    launcher::clean_up(layout, true);
    throw;
  }
  launcher::clean_up(layout, true);
}

}  // namespace

int force_command(const ForceOptions& options) {
  if (!options.self_test)
    throw launcher::BadInput(
        "force: nothing to do: allowed --self-test, which measures the estimate of contact forces on the bench: add "
        "it");
  const auto configurations = parse_whole("--configurations", options.configurations, 1, kMaxConfigurations);
  const auto pushes = parse_whole("--pushes", options.pushes, 1, kMaxPushes);
  const config::RobotConfig robot = robot_of(options);
  const launcher::InterruptGuard interrupts;
  report::ForceReadings all;
  for (std::int64_t i = 0; i < configurations; ++i) {
    std::fprintf(stderr, "configuration %lld of %lld\n", static_cast<long long>(i + 1),
                 static_cast<long long>(configurations));
    run(options, robot,
        launcher::force_plan(robot, static_cast<std::size_t>(i), static_cast<std::size_t>(pushes), options.seed),
        interrupts, all);
  }
  Json table = report::force_json(all);
  table["robot"] = robot.name;
  table["physics"] = options.physics;
  table["seed"] = options.seed;
  table["configurations"] = configurations;
  table["pushes"] = pushes;
  std::fputs((options.json ? table.dump() + "\n" : report::force_text(table)).c_str(), stdout);
  return launcher::kExitOk;
}

}  // namespace liana::cli
