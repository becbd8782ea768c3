#include "host/drives/bus_simulator/participant.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace liana::bus_simulator {

Participant::Participant(api::UniqueFd socket, const wire::Hello& hello)
    : socket_(std::move(socket)),
      name_(hello.name.data(), strnlen(hello.name.data(), hello.name.size())),
      role_(hello.role) {
  inbox_.reserve(4 * wire::kMaxPacketFrames);
}

bool Participant::wake(std::uint8_t flags, std::uint32_t slot, std::uint64_t now_us, bool block) {
  const std::size_t count = std::min(inbox_.size(), wire::kMaxPacketFrames);
  wake_->flags = static_cast<std::uint8_t>(flags | (sync_seen_ ? wire::kWakeSyncSeen : 0));
  wake_->frame_count = static_cast<std::uint16_t>(count);
  wake_->slot = slot;
  wake_->now_us = now_us;
  std::copy_n(inbox_.begin(), count, wake_->frame.begin());
  while (send(socket_.get(), wake_.get(), wake_->size(), MSG_NOSIGNAL | (block ? 0 : MSG_DONTWAIT)) < 0) {
    if (errno == EINTR) continue;
    return errno == EAGAIN || errno == EWOULDBLOCK;
  }
  inbox_.erase(inbox_.begin(), inbox_.begin() + static_cast<std::ptrdiff_t>(count));
  sync_seen_ = false;
  awake = true;
  return true;
}

Participant::Received Participant::receive(bool block) {
  const ssize_t size = recv(socket_.get(), yield_.get(), sizeof *yield_, block ? 0 : MSG_DONTWAIT);
  if (size < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return Received::kNothing;
  if (size <= 0) return Received::kGone;
  const bool whole = size >= static_cast<ssize_t>(wire::kHeaderBytes) && yield_->type == wire::Type::kYield &&
                     yield_->frame_count <= wire::kMaxPacketFrames && static_cast<std::size_t>(size) == yield_->size();
  if (!whole) return Received::kMalformed;
  return (yield_->flags & wire::kYieldLeave) != 0 ? Received::kGone : Received::kYield;
}

void Participant::refuse(const std::string& reason) {
  std::string packet(1, static_cast<char>(wire::Type::kError));
  packet += reason;
  send(socket_.get(), packet.data(), packet.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
}

}  // namespace liana::bus_simulator
