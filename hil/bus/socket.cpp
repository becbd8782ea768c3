#include "hil/bus/socket.hpp"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace liana::bench {

namespace {

volatile std::sig_atomic_t g_end_requested = 0;

}  // namespace

Socket::~Socket() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Socket& Socket::operator=(Socket&& other) noexcept {
  if (this == &other) return *this;
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = other.release();
  return *this;
}

int Socket::release() { return std::exchange(descriptor_, -1); }

Socket connect_local(const std::string& path, int patience_ms) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    throw std::runtime_error("socket path " + path + " is longer than " + std::to_string(sizeof address.sun_path - 1) +
                             " bytes; use a shorter one");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  constexpr int kRetry_ms = 20;
  for (int waited_ms = 0;; waited_ms += kRetry_ms) {
    Socket socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
    if (::connect(socket.descriptor(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return socket;
    if (waited_ms >= patience_ms || end_requested()) return Socket();
    ::usleep(kRetry_ms * 1000);
  }
}

bool end_requested() { return g_end_requested != 0; }

void end_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { g_end_requested = 1; };  // without SA_RESTART: blocking calls return
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

}  // namespace liana::bench
