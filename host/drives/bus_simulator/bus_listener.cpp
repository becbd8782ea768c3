#include "host/drives/bus_simulator/bus_listener.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <optional>

#include "host/base/net/peer.hpp"
namespace liana::bus_simulator {
namespace {

volatile std::sig_atomic_t g_stop = 0;
constexpr int kSocketBufferBytes = 1 << 20;

// HELLO of a new connection, or nothing when it says something else or nothing within a second.
std::optional<wire::Hello> read_hello(int descriptor) {
  const timeval patience{1, 0};
  setsockopt(descriptor, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  wire::Hello hello;
  const ssize_t size = recv(descriptor, &hello, sizeof hello, 0);
  if (size != static_cast<ssize_t>(sizeof hello) || hello.type != wire::Type::kHello) return std::nullopt;
  return hello;
}

std::string objection(const wire::Hello& hello, const std::vector<Participant>& present) {
  if (hello.version != wire::kVersion) {
    return "bus protocol version " + std::to_string(hello.version) + " asked, spoken is " +
           std::to_string(wire::kVersion) + "; use programs of one build";
  }
  if (hello.role != wire::Role::kController && hello.role != wire::Role::kPlant)
    return "unknown role; allowed are 0 controller and 1 plant";
  for (const Participant& other : present) {
    if (other.role() == hello.role)
      return "the bus has a " + std::string(hello.role == wire::Role::kPlant ? "plant" : "controller") +
             " already: " + other.name();
  }
  return "";
}

void admit_one(int listener, const wire::Welcome& welcome, std::vector<Participant>& present) {
  api::UniqueFd socket(accept4(listener, nullptr, nullptr, SOCK_CLOEXEC));
  if (socket.get() < 0 || !api::is_admitted(socket.get())) return;
  const std::optional<wire::Hello> hello = read_hello(socket.get());
  if (!hello) return;
  // A whole boot of the other side fits, so that sending hardly ever waits.
  setsockopt(socket.get(), SOL_SOCKET, SO_SNDBUF, &kSocketBufferBytes, sizeof kSocketBufferBytes);
  Participant newcomer(std::move(socket), *hello);
  const std::string reason = objection(*hello, present);
  if (!reason.empty()) return newcomer.refuse(reason);
  if (send(newcomer.descriptor(), &welcome, welcome.size(), MSG_NOSIGNAL) < 0) return;  // left already
  present.push_back(std::move(newcomer));
}

// Those that left before it began make room again.
void forget_the_gone(std::vector<Participant>& present) {
  std::erase_if(present, [](Participant& each) {
    char byte = 0;
    return recv(each.descriptor(), &byte, 1, MSG_PEEK | MSG_DONTWAIT) == 0;
  });
}

}  // namespace

void request_bus_stop() { g_stop = 1; }
bool bus_stop_requested() { return g_stop != 0; }

std::vector<Participant> admit_participants(const std::string& socket_path, const wire::Welcome& welcome) {
  const api::UniqueFd listener = api::listen_at("--socket", socket_path);
  std::vector<Participant> present;
  while (present.size() < 2 && !bus_stop_requested()) {
    pollfd ready{listener.get(), POLLIN, 0};
    const int count = poll(&ready, 1, 200);
    forget_the_gone(present);
    if (count > 0) admit_one(listener.get(), welcome, present);
  }
  unlink(socket_path.c_str());
  std::sort(present.begin(), present.end(),
            [](const Participant& a, const Participant& b) { return a.role() < b.role(); });
  return present;
}

}  // namespace liana::bus_simulator
