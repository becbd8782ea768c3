// Client of lianad's API socket that delivers camera pictures; it never waits for lianad.
#pragma once

#include <cstdint>
#include <string>

#include "hil/bus/socket.hpp"

namespace liana::bench {

class CameraLink {
 public:
  // An empty path means no link; nothing is connected yet.
  explicit CameraLink(std::string path) : path_(std::move(path)) {}

  // Connects and says hello as `camera` if that has not happened yet, trying for `patience_ms`.
  void connect(int patience_ms);
  // Sends one message; without a connection, or when lianad does not read, it is counted as lost.
  void send(const std::string& message);

  std::uint64_t sent() const { return sent_; }
  std::uint64_t lost() const { return lost_; }

 private:
  bool push(const std::string& message);
  void discard_answers();

  std::string path_;
  Socket socket_;
  std::uint64_t sent_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace liana::bench
