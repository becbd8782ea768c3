// The door to JSON: the only header that knows which library reads and writes it.
#pragma once

#include <nlohmann/json.hpp>

#include "host/json/json_fwd.hpp"
