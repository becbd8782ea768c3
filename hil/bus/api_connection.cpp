#include "hil/bus/api_connection.hpp"

#include <sys/socket.h>

#include <array>

namespace liana::bench {

void ApiConnection::connect(int patience_ms) {
  if (path_.empty() || socket_.open()) return;
  socket_ = connect_local(path_, patience_ms);
  if (!socket_.open()) return;
  const std::string topics = hello_.topic.empty() ? "" : '"' + hello_.topic + '"';
  push(R"({"op":"hello","name":"bench","role":")" + hello_.role + R"(","lockstep":false,"subscribe":[)" + topics +
       "]}");
}

bool ApiConnection::push(const std::string& message) {
  const ssize_t size = ::send(socket_.descriptor(), message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  return size == static_cast<ssize_t>(message.size());
}

void ApiConnection::receive(const std::function<void(const std::string&)>& take) {
  if (!socket_.open()) return;
  std::array<char, 65536> packet;
  for (;;) {
    const ssize_t size = ::recv(socket_.descriptor(), packet.data(), packet.size(), MSG_DONTWAIT);
    if (size <= 0) return;
    take(std::string(packet.data(), static_cast<std::size_t>(size)));
  }
}

void ApiConnection::send(const std::string& message) {
  if (path_.empty()) return;
  connect(0);
  if (!socket_.open() || !push(message)) {
    ++lost_;
    return;
  }
  ++sent_;
}

}  // namespace liana::bench
