// Connecting to a local socket whose program may still be starting.
#pragma once

#include <string>

#include "host/base/net/socket.hpp"

namespace liana::api {

// A connected socket that never blocks, tried for up to `timeout_s`; throws std::runtime_error that names the path, and
// the option of lianad that makes it listen there.
UniqueFd connect_to(const std::string& option, const std::string& path, double timeout_s);

}  // namespace liana::api
