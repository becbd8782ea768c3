// A client of lianad that looks, and may stop the arm or clear what stopped it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/base/json/json_fwd.hpp"

namespace liana::api {
class ApiClient;
}  // namespace liana::api

namespace liana::launcher {

// API sockets: `given` alone, or those of all running systems of this user; throws BadInput when there is none.
std::vector<std::string> systems_to_ask(const std::string& given);

// How a command of `liana` presents itself to lianad.
enum class Observer {
  kBlind,   // sees no states
  kSeeing,  // sees states
  kOwning,  // sees states, and may own motion and end lianad
  kClient,  // sees states and events, and may own motion
};

// The hello of such a command; `name` is what a stop's reason names.
Json hello(const std::string& name, Observer observer);

// Says hello without waiting for the welcome. Throws std::runtime_error when
// lianad is gone.
void say_hello(api::ApiClient& client, const std::string& name, Observer observer);

// Says hello, subscribes to states, returns the welcome. Throws std::runtime_error when lianad refuses or does not
// answer within 5 s.
Json hello_as_observer(api::ApiClient& client, const std::string& name);

// Waits for a message whose `op` is given, at most `timeout_s`; an error message of lianad throws std::runtime_error.
std::optional<Json> wait_for(api::ApiClient& client, const std::string& op, double timeout_s);

}  // namespace liana::launcher
