#include "host/base/net/peer.hpp"

#include <grp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace liana::api {

namespace {

bool is_member(int fd, const ucred& peer, gid_t group) {
  if (peer.gid == group) return true;
  std::vector<gid_t> groups(65536);  // NGROUPS_MAX of Linux
  auto bytes = static_cast<socklen_t>(groups.size() * sizeof(gid_t));
  if (::getsockopt(fd, SOL_SOCKET, SO_PEERGROUPS, groups.data(), &bytes) != 0) return false;
  groups.resize(bytes / sizeof(gid_t));
  return std::find(groups.begin(), groups.end(), group) != groups.end();
}

std::optional<ucred> credentials(int fd) {
  ucred found{};
  socklen_t bytes = sizeof found;
  if (::getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &found, &bytes) != 0) return std::nullopt;
  return found;
}

}  // namespace

std::optional<Peer> peer_of(int fd) {
  const std::optional<ucred> found = credentials(fd);
  if (!found) return std::nullopt;
  return Peer{found->pid, found->uid};
}

bool is_admitted(int fd, std::optional<gid_t> group) {
  const std::optional<ucred> peer = credentials(fd);
  if (!peer) return false;
  return peer->uid == ::geteuid() || peer->uid == 0 || (group && is_member(fd, *peer, *group));
}

gid_t group_named(const std::string& option, const std::string& name) {
  const ::group* found = ::getgrnam(name.c_str());
  if (found == nullptr) {
    throw std::runtime_error(option + ": '" + name +
                             "': no such group; allowed is one of getent group, or leave it out");
  }
  return found->gr_gid;
}

}  // namespace liana::api
