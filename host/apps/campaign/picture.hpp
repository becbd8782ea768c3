// A campaign as a picture, or two of them over each other.
#pragma once

#include <string>
#include <vector>

#include "host/apps/campaign/store.hpp"

namespace liana::campaign {

// Shares of outcomes with their intervals, and how each of `figures` is spread (share of rows below a value), as SVG.
std::string picture_of(const std::vector<Stored>& campaigns, const std::vector<std::string>& figures);

}  // namespace liana::campaign
