// `reach` along a path of joint angles, of cable arms only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/model/config/config.hpp"

namespace liana::cli {

// What `--hold` of `reach` names; none where it is not given. Throws BadInput.
std::vector<HoldArgument> holds_of(const ReachOptions& options, const cable::RobotParams& robot);

// Bit i: theta i + 1 is among them.
std::uint32_t mask_of(const std::vector<HoldArgument>& holds);

// Throws BadInput when every one of the first `theta_count` thetas, which move `what`, is held.
void require_free(std::uint32_t held_mask, std::int32_t theta_count, const std::string& what);

// Conditioning and limits along --path, or from --from-deg to --to-deg: prints them, draws --svg, returns the exit
// code. Throws BadInput.
int reach_along_path(const ReachOptions& options, const config::RobotConfig& robot);

}  // namespace liana::cli
