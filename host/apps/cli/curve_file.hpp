// The curve that `liana plan --follow=FILE` follows.
#pragma once

#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::cli {

// The points in the text of a curve's file (docs/reference/formats.md), which messages call `name`: 2 to 1000, base
// frame, m, neighbours at least 1 mm apart. Throws std::runtime_error, which names the point, counted from 1.
std::vector<Vec3> parse_curve(const std::string& text, const std::string& name);

}  // namespace liana::cli
