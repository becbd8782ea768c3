// Canonical JSON: one text for one value, so that a hash over it means something.
#pragma once

#include <string>

#include "host/base/json/json_fwd.hpp"

namespace liana::config {

// Shortest decimal text that reads back as exactly `value`; integers without a point, minus zero as 0. `value` must be
// finite.
std::string canonical_number(double value);

// `value` as one line: keys sorted, no blanks, numbers by canonical_number (1 and 1.0 are the same).
std::string canonical_json(const Json& value);

}  // namespace liana::config
