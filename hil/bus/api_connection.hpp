// Client of lianad's API socket for what is mounted at the tip, camera or tool; it never waits for lianad.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "hil/bus/socket.hpp"

namespace liana::bench {

class ApiConnection {
 public:
  // What is told of itself: role, and the topic it wants to hear, empty for none (docs/reference/api.md).
  struct Hello {
    std::string role;
    std::string topic;
  };

  // An empty path means no link; nothing is connected yet.
  ApiConnection(std::string path, Hello hello) : path_(std::move(path)), hello_(std::move(hello)) {}

  // Connects and says hello if that has not happened yet, trying for `patience_ms`.
  void connect(int patience_ms);
  // Sends one message; without a connection, or when lianad does not read, it is counted as lost.
  void send(const std::string& message);
  // Reads what lianad has said since the last call, answers included, message by message.
  void receive(const std::function<void(const std::string&)>& take);

  std::uint64_t sent() const { return sent_; }
  std::uint64_t lost() const { return lost_; }

 private:
  bool push(const std::string& message);

  std::string path_;
  Hello hello_;
  Socket socket_;
  std::uint64_t sent_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace liana::bench
