#include <cstdio>

#include "host/api/ground/definitions.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {

int ground_command(const GroundOptions& options) {
  if (!options.xtce && !options.cosmos && !options.markdown)
    throw launcher::BadInput("ground: says nothing to do: allowed --xtce, --cosmos or --markdown: give one of them");
  const std::string robot = launcher::evaluate_table("robot", options.robot);
  const ground::Sizes sizes = launcher::checked([&] { return ground::sizes_of(Json::parse(robot)); });
  const auto make = options.xtce ? ground::xtce : options.cosmos ? ground::cosmos : ground::ground_page;
  std::fputs(make(sizes).c_str(), stdout);
  return launcher::kExitOk;
}

}  // namespace liana::cli
