// How a payload's installation went, in words.
#pragma once

#include <string>

#include "host/base/json/json_fwd.hpp"

namespace liana::report {

// Lines of a report that has figures of an installation; of stages that were not reached there is none.
std::string payload_text(const Json& report);

}  // namespace liana::report
