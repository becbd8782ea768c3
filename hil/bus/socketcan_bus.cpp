#include "hil/bus/socketcan_bus.hpp"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "hil/bus/wall_clock.hpp"

namespace liana::bench {

namespace {

Socket open_interface(const std::string& name) {
  Socket socket(::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW));
  if (!socket.open())
    throw std::runtime_error("SocketCAN: this kernel has no CAN (" + std::string(std::strerror(errno)) +
                             "); load can-raw, or use the embedded bus (--bus-socket)");
  const unsigned index = ::if_nametoindex(name.c_str());
  if (index == 0)
    throw std::runtime_error("SocketCAN: there is no interface " + name + "; create it (`ip link add dev " + name +
                             " type vcan`) and set it up");
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  if (::bind(socket.descriptor(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("SocketCAN: cannot bind to " + name + ": " + std::strerror(errno) + "; is it up?");
  return socket;
}

}  // namespace

SocketCanBus::SocketCanBus(const std::vector<std::string>& interfaces, std::uint32_t period_us)
    : period_us_(period_us), start_us_(wall_clock_us()) {
  for (const auto& name : interfaces) sockets_.push_back(open_interface(name));
}

bool SocketCanBus::wait(Wake& wake) {
  wake.frames.clear();
  std::vector<pollfd> ready;
  for (const auto& socket : sockets_) ready.push_back({socket.descriptor(), POLLIN, 0});
  if (::poll(ready.data(), ready.size(), std::max(1, static_cast<int>(period_us_ / 1000))) < 0 && errno != EINTR)
    return false;
  if (end_requested()) return false;
  wake.now_us = wall_clock_us() - start_us_;
  for (std::size_t b = 0; b < sockets_.size(); ++b) {
    can_frame raw{};
    while (::read(sockets_[b].descriptor(), &raw, sizeof raw) == static_cast<ssize_t>(sizeof raw)) {
      if ((raw.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG | CAN_ERR_FLAG)) != 0) continue;
      CanFrame frame;
      frame.time_us = wake.now_us;
      frame.id = raw.can_id;
      frame.bus = static_cast<std::uint8_t>(b);
      frame.length = std::min<std::uint8_t>(raw.can_dlc, 8);
      std::copy_n(raw.data, 8, frame.data.begin());
      wake.frames.push_back(frame);
    }
  }
  return true;
}

void SocketCanBus::send(const FrameList& frames) {
  for (const CanFrame& frame : frames) {
    can_frame raw{};
    raw.can_id = frame.id;
    raw.can_dlc = frame.length;
    std::copy_n(frame.data.begin(), 8, raw.data);
    if (::write(sockets_[frame.bus].descriptor(), &raw, sizeof raw) != static_cast<ssize_t>(sizeof raw)) ++refused_;
  }
}

}  // namespace liana::bench
