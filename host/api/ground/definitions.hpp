// The dictionary for other tools and for people, with the lists as long as one robot has them.
#pragma once

#include <string>

#include "host/api/ground/dictionary.hpp"

namespace liana::ground {

// XTCE 1.2 (OMG formal/2018-02-04): telemetry with its checksum; telecommands without, which the ground system appends.
std::string xtce(const Sizes& sizes);
// Definitions of COSMOS, telecommands and telemetry in one file for a target LIANA.
std::string cosmos(const Sizes& sizes);
// docs/reference/ground-packets.md.
std::string ground_page(const Sizes& sizes);

}  // namespace liana::ground
