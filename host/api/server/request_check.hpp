// Requests against the table: everything that it refuses by itself, in the words of docs/reference/api.md.
#pragma once

#include <cstddef>

#include "host/api/server/arguments.hpp"
#include "host/api/server/request_table.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::api {

// The row of a request; throws RequestError bad_request about an op that is missing, no text, or not in the table.
const RequestRow& row_of(const Json& request);

// Throws RequestError when this operation is not for the robot's kind of arm (`refused`) or not for the role
// (`not_owner` where others may own motion, else `bad_request`).
void require_may(const RequestRow& row, Role role, const RequestBounds& bounds);

// Throws RequestError "field = value: allowed ...: what to do" about the first field that is unknown, missing or of
// another type (`bad_request`), or out of its range (`out_of_range`); "op" and "id" belong to every request. Without
// `bounds` names and types alone are checked. `first` is the number that messages give to the first entry of an array.
void check_fields(const RequestRow& row, const Json& request, const RequestBounds* bounds, std::size_t first = 0);

// The same, and the arguments.
Arguments checked(const RequestRow& row, const Json& request, const RequestBounds& bounds);

}  // namespace liana::api
