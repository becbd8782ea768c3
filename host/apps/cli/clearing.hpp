// What `liana clear` and `liana recover` say to the one system that they are about.
#pragma once

#include <string>

#include "host/api/server/client.hpp"
#include "host/base/event/event.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {

// The socket given, or that of the only running system; throws BadInput, naming `command`, where several run or none.
std::string only_system(const std::string& command, const std::string& given);

// The next state; throws std::runtime_error when none comes within 5 s, or lianad has answered with an error.
Json next_state(api::ApiClient& client);

// Sends `request` under this number and waits for its answer; throws std::runtime_error with lianad's refusal.
void ask(api::ApiClient& client, Json request, int id);

// Takes motion, by its name from the owner that `state` shows: lianad allows that after an emergency stop or 5 s of the
// owner's silence. Returns that owner, empty when nobody owned motion; throws as `ask`, with what to do.
std::string take_motion(api::ApiClient& client, const Json& state, int id);

// What lianad says, within 15 s, of the faults that it was to clear.
event::Event clear_verdict(api::ApiClient& client);

}  // namespace liana::cli
