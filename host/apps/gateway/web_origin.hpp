// Which pages may open a connection: browsers tell where a page came from, and what name it was asked for by.
#pragma once

#include <cstdint>
#include <string>

namespace liana::gateway {

// Whether the header Host names the gateway on loopback itself (127.0.0.1, localhost, [::1], with its port): any other
// name was made to point here by somebody else (DNS rebinding).
bool is_loopback_host(const std::string& host, std::uint16_t port);

// Whether a page of this origin is one of ours: served under the same name over the same scheme (`http` or `https`).
// Programs that are no browsers send no origin (empty) and are let through: they have the token, or they are here.
bool is_own_origin(const std::string& origin, const std::string& scheme, const std::string& host);

}  // namespace liana::gateway
