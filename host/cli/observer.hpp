// A client of lianad that looks, and may stop the arm.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace liana {

class ApiClient;

// File that names the API socket of the run started last, for `status` and `estop` without --api.
std::string current_api_link();

// `given`, or the socket of the run started last; throws BadInput when there is none.
std::string api_path(const std::string& given);

// Says hello as an observer; returns the welcome. Throws std::runtime_error when lianad refuses or does not answer within 5 s.
nlohmann::json hello_as_observer(ApiClient& client, bool subscribe_state);

// Waits for a message whose `op` is given, at most `timeout_s`; an error message of lianad throws std::runtime_error.
std::optional<nlohmann::json> wait_for(ApiClient& client, const std::string& op, double timeout_s);

}  // namespace liana
