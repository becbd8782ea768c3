#include "host/apps/gateway/api_connection.hpp"

#include <sys/socket.h>

#include <cerrno>
#include <utility>

#include "host/base/net/address.hpp"

namespace liana::gateway {

namespace {
constexpr int kAtOnce = 32;  // packets read before others have their turn
}  // namespace

ApiConnection::ApiConnection(Poller& poller, std::string path, Take take, Closed closed)
    : poller_(poller), path_(std::move(path)), take_(std::move(take)), closed_(std::move(closed)) {}

bool ApiConnection::connect() {
  const sockaddr_un address = api::unix_address(path_);
  api::UniqueFd fd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (fd.get() < 0 || ::connect(fd.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return false;
  fd_ = std::move(fd);
  watch(false);
  return true;
}

bool ApiConnection::send(std::string packet) {
  if (!is_open() || waiting_.size() >= kMaxWaiting || waiting_bytes_ + packet.size() > kMaxWaitingBytes) return false;
  const bool was_empty = waiting_.empty();
  waiting_bytes_ += packet.size();
  waiting_.push_back(std::move(packet));
  if (was_empty) flush();
  return true;
}

void ApiConnection::close() {
  if (!is_open()) return;
  poller_.forget(fd_.get());
  fd_ = api::UniqueFd();
  waiting_.clear();
  waiting_bytes_ = 0;
}

void ApiConnection::watch(bool for_room) {
  waits_for_room_ = for_room;
  poller_.watch(fd_.get(), EPOLLIN | (for_room ? static_cast<std::uint32_t>(EPOLLOUT) : 0u),
                [this](std::uint32_t events) { ready(events); });
}

void ApiConnection::ready(std::uint32_t events) {
  if ((events & EPOLLOUT) != 0) flush();
  if (is_open()) read();
}

void ApiConnection::read() {
  std::string packet;
  for (int i = 0; i < kAtOnce && is_open(); ++i) {
    const api::SocketResult result = api::receive_packet(fd_.get(), packet);
    if (result == api::SocketResult::kWouldBlock) return;
    if (result == api::SocketResult::kClosed) return lost();
    take_(packet);
  }
}

// That lianad has left is found by reading: what it said last is still there.
void ApiConnection::flush() {
  while (!waiting_.empty()) {
    const api::SocketResult result = api::send_packet(fd_.get(), waiting_.front());
    if (result == api::SocketResult::kWouldBlock) break;
    waiting_bytes_ -= waiting_.front().size();
    waiting_.pop_front();
  }
  if (waits_for_room_ == waiting_.empty()) watch(!waiting_.empty());
}

void ApiConnection::lost() {
  close();
  closed_();
}

}  // namespace liana::gateway
