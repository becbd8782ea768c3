// Buses for a robot that has none yet: what the simulated bench of any arm can be reached over.
#pragma once

#include <cstdint>
#include <string>

namespace liana::config {

// How many drives a checked robot table of either kind has. Throws as parse_robot does.
std::int32_t drive_count(const std::string& robot_text, const std::string& file);

// A bus table as canonical JSON for `drives` drives, 1 to 32, with the nodes 1, 2, ...: embedded, 250 Hz, on as few
// classical 1 Mbit/s buses as carry them with a worst-case load of at most 75 %, shared out evenly. Its name is
// bench_DRIVES.
std::string bench_buses(std::int32_t drives);

}  // namespace liana::config
