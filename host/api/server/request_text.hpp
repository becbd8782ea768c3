// Words for what stands in the table of requests: for refusals and for the pages that are made of it.
#pragma once

#include <string>
#include <string_view>

#include "host/api/server/request_table.hpp"

namespace liana::api {

// Shortest text of a number: "20", "0.01", "1e+300".
std::string text_of(double value);

// The same to a millionth, for what was computed.
std::string roughly(double value);

// The unit that a name ends in: " deg/s" of rate_deg_s; empty without one.
const char* unit_of(std::string_view name);

// What a field may be, apart from its range: "a whole number", "[x,y,z]".
std::string type_text(const RequestField& field);

// "mission, client"
std::string roles_text(Roles roles);

// "cable arms", "serial arms" or "every arm".
std::string arms_text(Arms arms);

}  // namespace liana::api
