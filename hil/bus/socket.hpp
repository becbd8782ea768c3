// Local packet sockets.
#pragma once

#include <string>

namespace liana::bench {

// A file descriptor that closes itself.
class Socket {
 public:
  explicit Socket(int descriptor = -1) : descriptor_(descriptor) {}
  ~Socket();
  Socket(Socket&& other) noexcept : descriptor_(other.release()) {}
  Socket& operator=(Socket&& other) noexcept;
  int descriptor() const { return descriptor_; }
  bool open() const { return descriptor_ >= 0; }

 private:
  int release();
  int descriptor_;
};

// Connects to an AF_UNIX SOCK_SEQPACKET socket, trying again for up to `patience_ms`; not open() when nobody listens by
// then. Throws std::runtime_error when the path is too long.
Socket connect_local(const std::string& path, int patience_ms);

// Listens at an AF_UNIX SOCK_SEQPACKET socket that only this user may use; accept does not wait. Throws
// std::runtime_error when that cannot be.
Socket listen_local(const std::string& path);

// Asks all loops to end; set by SIGINT and SIGTERM after end_on_signals().
bool end_requested();
void end_on_signals();

}  // namespace liana::bench
