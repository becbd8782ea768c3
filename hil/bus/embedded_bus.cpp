#include "hil/bus/embedded_bus.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "hil/bus/wall_clock.hpp"

namespace liana::bench {
namespace {

constexpr timeval kLookForEnd{0, 100000};  // a read without an end looks so often whether an end is asked for

}  // namespace

EmbeddedBus::EmbeddedBus(const std::string& socket_path, std::uint32_t period_us, std::size_t bus_count)
    : socket_(connect_local(socket_path, 10000)) {
  if (!socket_.open())
    throw std::runtime_error("embedded bus: nobody listens on " + socket_path + " (10 s); start liana-bus first");
  ::setsockopt(socket_.descriptor(), SOL_SOCKET, SO_RCVTIMEO, &kLookForEnd, sizeof kLookForEnd);
  write(make_hello("liana-bench"));
  Packet packet;
  if (!read(packet, -1))
    throw std::runtime_error("embedded bus: " + socket_path + " closed before WELCOME; see the bus's own message");
  welcome_ = read_welcome(packet);
  if (welcome_.period_us != period_us || welcome_.bus_names.size() != bus_count)
    throw std::runtime_error("embedded bus: runs " + std::to_string(welcome_.bus_names.size()) + " buses at " +
                             std::to_string(welcome_.period_us) + " us, the bus table says " +
                             std::to_string(bus_count) + " at " + std::to_string(period_us) +
                             "; give both the same table");
}

bool EmbeddedBus::read(Packet& packet, int timeout_ms) {
  packet.clear();
  pollfd ready{socket_.descriptor(), POLLIN, 0};
  const int count = timeout_ms < 0 ? 1 : ::poll(&ready, 1, timeout_ms);  // without an end the read itself waits
  if (count == 0) return true;                                           // nothing in time: an empty packet
  if (count < 0) return false;                                           // a signal
  packet.resize(kMaxPacketBytes);
  ssize_t size;
  do {  // a signal between the look and the read does not end the read: the time does
    size = ::recv(socket_.descriptor(), packet.data(), packet.size(), 0);
  } while (size < 0 && (errno == EAGAIN || errno == EINTR) && !end_requested());
  if (size <= 0) return false;
  packet.resize(static_cast<std::size_t>(size));
  return true;
}

void EmbeddedBus::write(const Packet& packet) {
  while (::send(socket_.descriptor(), packet.data(), packet.size(), MSG_NOSIGNAL) < 0) {
    if (errno == EINTR) continue;
    ended_ = errno == EPIPE || errno == ECONNRESET;
    if (ended_) return;
    throw std::runtime_error(std::string("embedded bus: sending failed: ") + std::strerror(errno));
  }
}

// The bus wakes everybody when all are there. Until then it has no time: drives whose clocks went on by another one
// would stand still until the bus has caught up, and send no heartbeat.
bool EmbeddedBus::wait(Wake& wake) {
  Packet packet;
  const int timeout_ms = lockstep() ? -1 : std::max(1, static_cast<int>(period_us() / 1000));
  do {
    if (ended_ || end_requested() || !read(packet, timeout_ms)) return false;
  } while (packet.empty() && !has_begun_);
  has_begun_ = true;
  wake.frames.clear();
  if (packet.empty()) {  // real time only: drives run on without frames
    wake.now_us = now_us_ + (wall_clock_us() - wall_at_now_us_);
    return true;
  }
  WakePacket woken = read_wake(packet);
  refused_ += woken.refused;
  slot_ = woken.slot;
  now_us_ = woken.now_us;
  wall_at_now_us_ = wall_clock_us();
  wake.now_us = woken.now_us;
  wake.slot = woken.slot;
  wake.frames = std::move(woken.frames);
  ended_ = woken.shutdown;
  return !ended_;
}

void EmbeddedBus::send(const FrameList& frames) {
  if (!lockstep() && frames.empty()) return;
  // Without SYNC the bench still runs: at the end of the slot after the present one.
  const std::uint64_t until_us = (static_cast<std::uint64_t>(slot_) + 2) * period_us();
  if (frames.size() > kMaxPacketFrames)
    throw std::runtime_error("embedded bus: " + std::to_string(frames.size()) +
                             " frames in one YIELD, allowed are 256");
  write(make_yield(true, until_us, frames));
}

}  // namespace liana::bench
