// Which numbers a record holds, and where: the same for all states of one life of lianad.
#pragma once

#include <cstddef>
#include <vector>

#include "host/api/telemetry/fields.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::telemetry {

// A field of `count` values, the first at byte `offset` of the record.
struct Place {
  Field field;
  std::size_t offset = 0;
  std::size_t count = 0;
};

struct Layout {
  std::vector<Place> places;
  std::size_t bytes = 0;  // of a record, header included
};

// The layout of the states of which this is one: fields that the arm does not have are left out, those that are null
// for now are not. Throws JsonError when it is no state.
Layout layout_of(const Json& state);

// {"version":1,"bytes":N,"fields":[{"name","unit","offset","count"}]}
Json to_json(const Layout& layout);
// The layout that to_json() wrote. Throws JsonError for another version, fields that are not known, and places that are
// not within a record.
Layout layout_from(const Json& json);

}  // namespace liana::telemetry
