// What became of a command as one JSON object (docs/reference/command-line.md, `liana commands --json`).
#pragma once

#include "host/apps/report/command_lives.hpp"
#include "host/base/json/json_fwd.hpp"

namespace liana::report {

// tip, joints, retract, request (none came of it), other.
const char* command_kind_name(const CommandRecord& life);

// Stages that have not come are null; margins where nothing was looked at, too.
Json command_json(const CommandRecord& life);

}  // namespace liana::report
