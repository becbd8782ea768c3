// What comes to the gateway's port before anybody has said who he is, through the real library: requests of HTTP,
// upgrades, frames after them; in the clear, at the port of TLS in place of a handshake, and within TLS. An input is
// sent in pieces: SPLIT ends one. PORT in it is what an input cannot know. It begins with T for within TLS, with R for
// raw bytes to the port of TLS, with anything else for the port without.
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <optional>

#include "host/apps/gateway/web_server.hpp"
#include "host/base/net/socket.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/fuzz/tls_client.hpp"

using namespace liana;

namespace {

constexpr int kMaxTurns = 8;  // of the server for a piece, until it waits for more
constexpr int kMaxShakes = 6;
constexpr std::size_t kPageBytes = 300'000;  // more than a socket takes at once
double now_s = 0.0;                          // goes on with every input, as fast as years would

// A text as a file for whoever takes a path.
std::string in_memory(const std::string& text) {
  static std::array<fuzz::MemoryFile, 3> files;
  static std::size_t next = 0;
  return files[next++].with(text);
}

struct Served {
  explicit Served(const gateway::WebOptions& options)
      : house("/nonexistent/api", "/nonexistent/devices", nullptr, true, [] { return now_s; }), server(options, house) {
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, nullptr);  // the fuzzer wants its own
    const std::string address = server.address();
    port = address.substr(address.rfind(':') + 1);
    port.pop_back();
  }
  gateway::Gateway house;
  gateway::WebServer server;
  std::string port;
};

gateway::WebOptions options(bool with_tls) {
  static const std::string page = in_memory(std::string(kPageBytes, 'x'));
  gateway::WebOptions out;
  out.listen = {"127.0.0.1", 0};
  out.runs = "/nonexistent/runs";
  out.page = page;
  if (!with_tls) return out;
  const fuzz::Certificate made = fuzz::made_certificate();
  out.certificate = in_memory(made.certificate);
  out.key = in_memory(made.key);
  return out;
}

class Connection {
 public:
  Connection(Served& served, bool within_tls) : served_(served) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0, ends.data()) != 0) std::abort();
    client_ = api::UniqueFd(ends[0]);
    if (!served_.server.take_connection(ends[1])) std::abort();
    if (!within_tls) return;
    tls_.emplace(client_.get());
    bool done = false;
    for (int i = 0; i < kMaxShakes && !done; ++i) {
      done = tls_->shake_hands();
      served_.server.serve_waiting();
    }
    if (!done) std::abort();
  }
  ~Connection() {
    tls_.reset();
    client_ = api::UniqueFd();
    served_.server.serve_waiting();  // finds that it has ended
  }
  void say(std::string_view piece) {
    if (tls_) {
      tls_->send(piece);
    } else {
      ::send(client_.get(), piece.data(), piece.size(), MSG_NOSIGNAL);
    }
    for (int i = 0; i < kMaxTurns; ++i) {
      served_.server.serve_waiting();
      const ssize_t count = ::recv(client_.get(), answer_.data(), answer_.size(), MSG_DONTWAIT);
      if (count == 0) return;
    }
  }

 private:
  Served& served_;
  api::UniqueFd client_;
  std::optional<fuzz::TlsClient> tls_;
  std::array<char, 65536> answer_{};
};

void replace(std::string& text, std::string_view word, const std::string& by) {
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static Served clear(options(false)), secured(options(true));
  std::string text(fuzz::text_of(data, size));
  const bool within_tls = text.starts_with('T'), raw = text.starts_with('R');
  if (within_tls || raw) text.erase(0, 1);
  Served& served = within_tls || raw ? secured : clear;
  replace(text, "PORT", served.port);
  now_s += 0.01;
  Connection connection(served, within_tls);
  constexpr std::string_view kSplit = "SPLIT";
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t end = std::min(rest.find(kSplit), rest.size());
    connection.say(rest.substr(0, end));
    rest.remove_prefix(std::min(end + kSplit.size(), rest.size()));
  }
  return 0;
}
