// Who is at the other end of a local socket, as the kernel says: nobody can claim it.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace liana::api {

struct Peer {
  pid_t process = 0;
  uid_t user = 0;
};

// Of a connected local socket (SO_PEERCRED); nothing when the kernel does not say.
std::optional<Peer> peer_of(int fd);

// Whether the peer may talk to this program: it is of our own user or of root, or a member of `group`, where one is
// given (SO_PEERGROUPS).
bool is_admitted(int fd, std::optional<gid_t> group = std::nullopt);

// The number of a group that `option` names; throws std::runtime_error when there is none.
gid_t group_named(const std::string& option, const std::string& name);

}  // namespace liana::api
