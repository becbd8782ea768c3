// What comes to the gateway's port: requests of HTTP, upgrades to a WebSocket, and frames after them, over a real
// connection within this process.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "host/api/socket.hpp"
#include "host/gateway/web_server.hpp"
#include "tests/fuzz/fuzz.hpp"

using namespace liana;

namespace {

constexpr int kMostTries = 100;
constexpr int kMostTurns = 12;  // of the server, until it has answered or waits for more

struct Served {
  Served()
      : house("/nonexistent/api", "/nonexistent/devices", nullptr, true, [] { return 0.0; }), server(options(), house) {
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);  // the fuzzer wants its own
    const std::string address = server.address();
    port = static_cast<std::uint16_t>(std::stoul(address.substr(address.rfind(':') + 1)));
  }
  static gateway::WebOptions options() {
    gateway::WebOptions out;
    out.listen = {"127.0.0.1", 0};
    out.runs = "/nonexistent/runs";
    return out;
  }
  gateway::Gateway house;
  gateway::WebServer server;
  std::uint16_t port = 0;
};

// A connection that is reset when it is closed, never ended by this side: millions of them follow each other, and each
// that had ended in order would keep its port for a minute.
api::UniqueFd connected(std::uint16_t port) {
  api::UniqueFd fd(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const linger at_once{1, 0};
  ::setsockopt(fd.get(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  sockaddr_in there{};
  there.sin_family = AF_INET;
  there.sin_port = htons(port);
  there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (int tries = 0; ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&there), sizeof there) != 0; ++tries) {
    if (tries == kMostTries) std::abort();
    ::usleep(100'000);  // this machine may be out of ports for a while
  }
  return fd;
}

bool has_ended(int socket) {
  std::array<char, 4096> answer{};
  return ::recv(socket, answer.data(), answer.size(), MSG_DONTWAIT) == 0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Served served;
  const api::UniqueFd client = connected(served.port);
  std::string text(fuzz::text_of(data, size));
  const std::string kPort = std::to_string(served.port);  // what an input cannot know
  for (std::size_t at = text.find("PORT"); at != text.npos; at = text.find("PORT", at)) text.replace(at, 4, kPort);
  ::send(client.get(), text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  for (int i = 0; i < kMostTurns && !has_ended(client.get()); ++i) served.server.serve_waiting();
  return 0;
}
