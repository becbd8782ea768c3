// AF_UNIX SOCK_SEQPACKET sockets: who listens, one packet in, one packet out; for both ends of the API and of the
// embedded bus.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace liana::api {

// Largest packet of the API in bytes; longer ones are refused by both ends.
constexpr std::size_t kMaxPacketBytes = 131072;

// Owns one file descriptor.
class UniqueFd {
 public:
  UniqueFd() = default;
  explicit UniqueFd(int fd) : fd_(fd) {}
  UniqueFd(UniqueFd&& other) noexcept : fd_(other.release()) {}
  UniqueFd& operator=(UniqueFd&& other) noexcept;
  ~UniqueFd();
  // The descriptor, or -1.
  int get() const { return fd_; }
  // Gives the descriptor away.
  int release();

 private:
  int fd_ = -1;
};

enum class SocketResult { kDone, kWouldBlock, kClosed };

// Writes one packet without waiting; kClosed when the peer is gone.
SocketResult send_packet(int fd, std::string_view packet);

// Writes packets in their order with as few calls as there can be, without waiting; says why it ended, and takes those
// that were written away from the front of `packets`.
SocketResult send_packets(int fd, std::span<const std::string_view>& packets);

// Reads one packet without waiting; kClosed when the peer is gone. Packets over `most_bytes` arrive cut to that size
// plus one. The text is only as large as the packet.
SocketResult receive_packet(int fd, std::string& packet, std::size_t most_bytes = kMaxPacketBytes);

// The packets of one socket, read many with one call. Those over `most_bytes` arrive cut to that size plus one.
class PacketReader {
 public:
  explicit PacketReader(std::size_t most_bytes);
  // The next packet, without waiting; its bytes are good until the next call. kClosed when the peer is gone.
  SocketResult next(int fd, std::string_view& packet);

 private:
  static constexpr std::size_t kAtOnce = 32;

  SocketResult read(int fd);

  std::size_t room_bytes_;  // of one packet
  std::vector<char> bytes_;
  std::vector<std::size_t> sizes_;  // of the packets read last
  std::size_t next_ = 0;            // of them
  bool is_drained_ = false;         // that was all there was
};

// The most that await_packet waits at `fd` from now on: `timeout_s` over 0.
void limit_wait(int fd, double timeout_s);
// Reads one packet of at most kMaxPacketBytes, waiting for it; kWouldBlock when none came, or a signal did.
SocketResult await_packet(int fd, std::string& packet);

// A connection that waits at `listener`, non-blocking; none where nobody waits, and errno says why.
UniqueFd accept_now(int listener);
// Opens `spare`, where it is not open, on nothing: to be given up where a connection finds no other descriptor.
void keep_spare(UniqueFd& spare);
// The same as accept_now(). Where this process may have no further
// descriptor, `spare` is given up for a moment to turn the connection away: who polls the listener would never sleep.
UniqueFd accept_or_turn_away(int listener, UniqueFd& spare);

// Waits until `fd` is readable (or writable), at most `timeout_s`; true when it is.
bool wait_readable(int fd, double timeout_s);
bool wait_writable(int fd, double timeout_s);

// A local packet socket that never waits, connected to `path`, however long that is; without a descriptor where it
// cannot be, and errno says why not.
UniqueFd try_to_connect(const std::string& path);

// Somebody listens at `path`, though perhaps too busy to answer; errno says why not.
bool is_listening(const std::string& path);

// A listening socket at `path`, which the program was given with `option`; replaces a stale socket file. Accepting from
// it never waits. Whatever the umask, only its user may connect, and members of `group` where one is given. Throws
// std::runtime_error when the path is in use, no socket, too long or not writable, or cannot be given to the group.
UniqueFd listen_at(const std::string& option, const std::string& path, std::optional<gid_t> group = std::nullopt);

}  // namespace liana::api
