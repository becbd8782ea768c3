#include "hil/bus/socket.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace liana::bench {

namespace {

constexpr int kBacklog = 16;

volatile std::sig_atomic_t g_end_requested = 0;

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path)
    throw std::runtime_error("socket path " + path + " is longer than " + std::to_string(sizeof address.sun_path - 1) +
                             " bytes; use a shorter one");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

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

Socket listen_local(const std::string& path) {
  const sockaddr_un address = address_of(path);
  Socket socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  const mode_t before = ::umask(0177);
  const bool is_bound = ::bind(socket.descriptor(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::umask(before);
  if (!is_bound || ::listen(socket.descriptor(), kBacklog) != 0)
    throw std::runtime_error("socket " + path + ": " + std::strerror(errno) + "; take another path");
  return socket;
}

Socket connect_local(const std::string& path, int patience_ms) {
  const sockaddr_un address = address_of(path);
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
