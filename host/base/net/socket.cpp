#include "host/base/net/socket.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "host/base/net/address.hpp"

namespace liana::api {

UniqueFd& UniqueFd::operator=(UniqueFd&& other) noexcept {
  if (this != &other) {
    if (fd_ >= 0) ::close(fd_);
    fd_ = other.release();
  }
  return *this;
}

UniqueFd::~UniqueFd() {
  if (fd_ >= 0) ::close(fd_);
}

int UniqueFd::release() { return std::exchange(fd_, -1); }

namespace {

SocketResult why_not_sent(int reason) {
  const bool full = reason == EAGAIN || reason == EWOULDBLOCK || reason == ENOBUFS;
  return full ? SocketResult::kWouldBlock : SocketResult::kClosed;
}

}  // namespace

SocketResult send_packet(int fd, std::string_view packet) {
  while (::send(fd, packet.data(), packet.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0) {
    if (errno != EINTR) return why_not_sent(errno);
  }
  return SocketResult::kDone;
}

SocketResult send_packets(int fd, std::span<const std::string_view>& packets) {
  std::array<mmsghdr, 32> messages{};
  std::array<iovec, messages.size()> parts{};
  while (!packets.empty()) {
    const std::size_t count = std::min(packets.size(), messages.size());
    for (std::size_t i = 0; i < count; ++i) {
      parts[i] = {const_cast<char*>(packets[i].data()), packets[i].size()};  // only read
      messages[i].msg_hdr.msg_iov = &parts[i];
      messages[i].msg_hdr.msg_iovlen = 1;
    }
    const int sent = ::sendmmsg(fd, messages.data(), static_cast<unsigned>(count), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EINTR) return why_not_sent(errno);
    packets = packets.subspan(static_cast<std::size_t>(std::max(sent, 0)));
  }
  return SocketResult::kDone;
}

namespace {

// With one call, into a buffer for the largest packet of the API; on the stack each of its pages would be touched.
ssize_t receive_at_once(int fd, std::string& packet, std::size_t most_bytes, int flags) {
  static thread_local std::array<char, kMaxPacketBytes + 1> bytes;
  const ssize_t size = ::recv(fd, bytes.data(), most_bytes + 1, flags);
  if (size > 0) packet.assign(bytes.data(), static_cast<std::size_t>(size));
  return size;
}

// The size first: a buffer for the largest packet would have to be made anew for each small one.
ssize_t receive_by_size(int fd, std::string& packet, std::size_t most_bytes) {
  const ssize_t size = ::recv(fd, nullptr, 0, MSG_DONTWAIT | MSG_PEEK | MSG_TRUNC);
  if (size <= 0) return size;
  packet.resize(std::min(static_cast<std::size_t>(size), most_bytes + 1));
  return ::recv(fd, packet.data(), packet.size(), MSG_DONTWAIT);
}

SocketResult result_of(ssize_t size, int reason) {
  if (size > 0) return SocketResult::kDone;
  const bool nothing = size < 0 && (reason == EAGAIN || reason == EWOULDBLOCK || reason == EINTR);
  return nothing ? SocketResult::kWouldBlock : SocketResult::kClosed;
}

}  // namespace

SocketResult receive_packet(int fd, std::string& packet, std::size_t most_bytes) {
  for (;;) {
    const ssize_t size = most_bytes <= kMaxPacketBytes ? receive_at_once(fd, packet, most_bytes, MSG_DONTWAIT)
                                                       : receive_by_size(fd, packet, most_bytes);
    // A peer that left without reading everything is reported once as a reset; what it sent before is still there.
    if (size < 0 && (errno == EINTR || errno == ECONNRESET)) continue;
    if (size <= 0) packet.clear();
    return result_of(size, errno);
  }
}

PacketReader::PacketReader(std::size_t most_bytes) : room_bytes_(most_bytes + 1) {}

SocketResult PacketReader::next(int fd, std::string_view& packet) {
  if (next_ == sizes_.size()) {
    const bool is_drained = std::exchange(is_drained_, false);
    const SocketResult result = is_drained ? SocketResult::kWouldBlock : read(fd);
    if (result != SocketResult::kDone) return result;
  }
  if (sizes_[next_] == 0) return SocketResult::kClosed;  // packets of no bytes are not sent
  packet = {&bytes_[next_ * room_bytes_], sizes_[next_]};
  ++next_;
  return SocketResult::kDone;
}

SocketResult PacketReader::read(int fd) {
  bytes_.resize(kAtOnce * room_bytes_);
  std::array<mmsghdr, kAtOnce> messages{};
  std::array<iovec, kAtOnce> rooms{};
  for (std::size_t i = 0; i < kAtOnce; ++i) {
    rooms[i] = {&bytes_[i * room_bytes_], room_bytes_};
    messages[i].msg_hdr.msg_iov = &rooms[i];
    messages[i].msg_hdr.msg_iovlen = 1;
  }
  int count = -1;
  do {
    count = ::recvmmsg(fd, messages.data(), kAtOnce, MSG_DONTWAIT, nullptr);
  } while (count < 0 && (errno == EINTR || errno == ECONNRESET));
  sizes_.clear();
  next_ = 0;
  if (count <= 0) return result_of(count, errno);
  for (int i = 0; i < count; ++i) sizes_.push_back(messages[static_cast<std::size_t>(i)].msg_len);
  is_drained_ = sizes_.size() < kAtOnce && sizes_.back() != 0;
  return SocketResult::kDone;
}

void limit_wait(int fd, double timeout_s) {
  ::fcntl(fd, F_SETFL, ::fcntl(fd, F_GETFL) & ~O_NONBLOCK);
  const long timeout_us = std::lround(timeout_s * 1e6);
  const timeval limit{timeout_us / 1'000'000, std::max(1000L, timeout_us % 1'000'000)};
  ::setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
}

SocketResult await_packet(int fd, std::string& packet) {
  for (;;) {
    const ssize_t size = receive_at_once(fd, packet, kMaxPacketBytes, 0);
    if (size < 0 && errno == ECONNRESET) continue;
    if (size <= 0) packet.clear();
    return result_of(size, errno);
  }
}

namespace {
bool wait_for(int fd, short events, double timeout_s) {
  pollfd p{fd, events, 0};
  const int timeout_ms = timeout_s <= 0.0 ? 0 : static_cast<int>(timeout_s * 1e3) + 1;
  return ::poll(&p, 1, timeout_ms) > 0;
}
}  // namespace

UniqueFd accept_now(int listener) {
  return UniqueFd(::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
}

void keep_spare(UniqueFd& spare) {
  if (spare.get() < 0) spare = UniqueFd(::open("/dev/null", O_RDONLY | O_CLOEXEC));
}

UniqueFd accept_or_turn_away(int listener, UniqueFd& spare) {
  keep_spare(spare);
  UniqueFd fd = accept_now(listener);
  if (fd.get() >= 0 || (errno != EMFILE && errno != ENFILE)) return fd;
  spare = UniqueFd();
  accept_now(listener);  // and closed
  keep_spare(spare);
  return UniqueFd();
}

bool wait_readable(int fd, double timeout_s) { return wait_for(fd, POLLIN, timeout_s); }
bool wait_writable(int fd, double timeout_s) { return wait_for(fd, POLLOUT, timeout_s); }

// An address holds 107 bytes; the descriptor of a file with a longer path has a short name of its own.
UniqueFd try_to_connect(const std::string& path) {
  UniqueFd place;
  std::string name = path;
  if (path.empty() || path.size() >= sizeof(sockaddr_un::sun_path)) {
    place = UniqueFd(::open(path.c_str(), O_PATH | O_CLOEXEC));
    if (place.get() < 0) return {};
    name = "/proc/self/fd/" + std::to_string(place.get());
  }
  const sockaddr_un address = unix_address(name);
  UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (fd.get() < 0 || ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) return fd;
  const int why = errno;
  fd = UniqueFd();
  errno = why;
  return fd;
}

bool is_listening(const std::string& path) { return try_to_connect(path).get() >= 0 || errno == EAGAIN; }

UniqueFd listen_at(const std::string& option, const std::string& path, std::optional<gid_t> group) {
  const auto fail = [&](const std::string& why) { throw std::runtime_error(option + " " + path + ": " + why); };
  if (is_listening(path)) fail("another program listens there; end it or give another path");
  std::error_code unreadable;
  const auto kind = std::filesystem::status(path, unreadable).type();
  if (kind != std::filesystem::file_type::not_found && kind != std::filesystem::file_type::socket) {
    fail("a file that is no socket is there; give another path");
  }
  // The path appears only when it can be connected to: those who wait for it start at once.
  const std::string before = path + "~";
  const sockaddr_un address = unix_address(before);
  ::unlink(before.c_str());
  UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (fd.get() < 0 || ::bind(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::chmod(before.c_str(), group ? 0660 : 0600) != 0 ||
      (group && ::chown(before.c_str(), static_cast<uid_t>(-1), *group) != 0) || ::listen(fd.get(), 64) != 0 ||
      ::rename(before.c_str(), path.c_str()) != 0) {
    fail(std::string("cannot listen: ") + std::strerror(errno) + "; give a path in a folder you may write");
  }
  return fd;
}

}  // namespace liana::api
