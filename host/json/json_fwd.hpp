// JSON by name, for headers that only pass it on.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace liana {

using Json = nlohmann::json;

}  // namespace liana
