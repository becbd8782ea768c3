// Reads what programs write to each other: JSON in ASCII without escapes, several times as fast as the library.
#pragma once

#include <optional>
#include <string_view>

#include "host/base/json/json.hpp"

namespace liana {

// The value of a whole text; nothing when it has anything unusual or wrong in it, which Json::parse leaves to the
// library: escapes, bytes beyond ASCII, numbers too large or small for their types, members given twice that are to be
// refused, more than Json::kMaxLevels, syntax errors.
std::optional<Json> read_plain(std::string_view text, Json::Twice twice);

}  // namespace liana
