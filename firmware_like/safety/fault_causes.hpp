// Which fault is a consequence of which: people look at the cause. The rows stand beside the fault table (faults.cpp).
#pragma once

#include <cstdint>
#include <optional>

#include "firmware_like/safety/faults.hpp"

namespace liana {

// True when `later` follows from `cause` by the rows of the table: latched in the same tick or later, and of the same
// drive where the row says so.
bool is_consequence(const Fault& cause, const Fault& later) noexcept;

// Place in the list of the first cause of fault `i`; nothing when it is a cause itself. A cause of a cause counts: what
// is returned has no cause.
std::optional<std::int32_t> cause_of(const FaultList& list, std::int32_t i) noexcept;

}  // namespace liana
