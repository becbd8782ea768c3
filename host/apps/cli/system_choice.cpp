#include "host/apps/cli/system_choice.hpp"

#include <vector>

#include "host/api/server/registry.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/observer.hpp"

namespace liana::cli {
namespace {

// What says how the simulated arm is to be means nothing to a system that runs.
void require_no_wishes(const launcher::RunOptions& run, const std::string& api) {
  const launcher::RunOptions none;
  const auto refuse = [&](const char* option, bool given) {
    if (given)
      throw launcher::BadInput(std::string(option) + ": a system runs already, at " + api +
                               "; leave it out, or add --simulate for another, simulated arm");
  };
  refuse("--robot", run.robot != none.robot);
  refuse("--scene", run.scene != none.scene);
  refuse("--bus", run.bus != none.bus);
  refuse("--start-pose", run.start_pose != none.start_pose);
  refuse("--faults", run.faults != none.faults);
  refuse("--physics", run.physics != none.physics);
  refuse("--calibration", run.calibration != none.calibration);
  refuse("--seed", run.seed != none.seed);
}

std::string running_one(const char* command, const SystemSelection& wish) {
  if (!wish.api.empty()) return launcher::systems_to_ask(wish.api).front();
  if (wish.simulate) return {};
  const std::vector<std::string> systems = api::running_systems();
  if (systems.size() > 1)
    throw launcher::BadInput(std::string(command) + ": " + std::to_string(systems.size()) +
                             " systems run; name one with --api (liana status lists them), or --simulate another arm");
  return systems.empty() ? std::string() : systems.front();
}

}  // namespace

std::string system_to_join(const char* command, const SystemSelection& wish) {
  std::string api = running_one(command, wish);
  if (!api.empty()) require_no_wishes(wish.run, api);
  return api;
}

}  // namespace liana::cli
