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

// What lianad says, within 15 s, of the faults that it was to clear.
event::Event clear_verdict(api::ApiClient& client);

}  // namespace liana::cli
