#include "host/base/net/address.hpp"

#include <sys/socket.h>

#include <cstring>
#include <stdexcept>

namespace liana::api {

sockaddr_un unix_address(const std::string& path) {
  sockaddr_un address{};
  if (path.empty() || path.size() >= sizeof address.sun_path) {
    throw std::runtime_error("socket path '" + path + "': allowed are paths of 1 to " +
                             std::to_string(sizeof address.sun_path - 1) + " bytes; choose a shorter folder");
  }
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.data(), path.size());
  return address;
}

}  // namespace liana::api
