// The stability map as a picture: a panel for each law and layer, delay to the right, stiffness of the hand upwards;
// eight small squares in each place: two hands' masses above each other, four walls beside each other.
#pragma once

#include <string>
#include <vector>

#include "tests/numbers/stability_map.hpp"

namespace liana::numbers {

// SVG text of all cells (192 for each law and layer).
std::string stability_picture(const std::vector<Judged>& map);

}  // namespace liana::numbers
