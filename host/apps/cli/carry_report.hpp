// What an arm can carry, for people and as JSON: liana reach --carry and liana robot check.
#pragma once

#include <vector>

#include "host/base/json/json.hpp"
#include "host/planning/workspace/carry.hpp"

namespace liana::cli {

// For every mounting.
std::vector<workspace::Carried> all_carried(const config::RobotConfig& robot, std::int32_t samples, std::uint64_t seed);

// A list: mounting, share of the poses by band, the hardest pose, and the payloads (null without gravity). Cables count
// from 1.
Json carry_json(const config::RobotConfig& robot, const std::vector<workspace::Carried>& carried);

// A line for every entry of that list.
void print_carry(const Json& carries);

}  // namespace liana::cli
