// Events as the API and recordings write them.
#pragma once

#include "host/base/event/event.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::event {

// JSON Schema of one event; what event_json() gives is valid against it.
extern const char* const kEventSchema;

// {"op":"event","sequence":..,"tick":..,"kind":"..","number":..,"subject":"..","values":{..},"text":".."}; a value that
// is not finite is null there.
Json event_json(const Event& event);

// The event of such an object. Throws JsonError when a member is missing, is of another type, or the kind has no such
// name.
Event event_from_json(const Json& json);

}  // namespace liana::event
