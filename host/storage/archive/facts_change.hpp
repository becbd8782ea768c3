// Facts as what has changed in them: those of a mission differ in one or two members from the ones before.
#pragma once

#include <optional>

#include "host/base/json/json_fwd.hpp"

namespace liana::archive {

// The members of `now` that are new or other than in `before`; nothing when one is no longer there.
std::optional<Json> change_of(const Json& before, const Json& now);

// `before` with the members of `change` in place of its own.
Json with_change(Json before, const Json& change);

}  // namespace liana::archive
