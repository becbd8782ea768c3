// The address of a local socket.
#pragma once

#include <sys/un.h>

#include <string>

namespace liana::api {

// Address for `path`; throws std::runtime_error when it is empty or longer than the system allows (107 bytes).
sockaddr_un unix_address(const std::string& path);

}  // namespace liana::api
