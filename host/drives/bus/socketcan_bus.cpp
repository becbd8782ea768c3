#include "host/drives/bus/socketcan_bus.hpp"

#include <linux/can.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "host/drives/bus/can_interface.hpp"

namespace liana::bus {
namespace {

can_frame to_kernel(const CanFrame& frame) noexcept {
  can_frame raw{};
  raw.can_id = frame.id;
  raw.can_dlc = frame.length;
  std::copy_n(frame.data.begin(), 8, raw.data);
  return raw;
}

CanFrame from_kernel(const can_frame& raw, std::uint64_t time_us) noexcept {
  CanFrame frame;
  frame.id = raw.can_id;
  frame.length = std::min<std::uint8_t>(raw.can_dlc, 8);
  std::copy_n(raw.data, 8, frame.data.begin());
  frame.time_us = time_us;
  return frame;
}

}  // namespace

SocketCanBus::SocketCanBus(const config::BusesConfig& config)
    : RealtimeBus(static_cast<std::uint32_t>(config.period_us())) {
  try {
    for (const config::BusConfig& bus : config.buses) {
      descriptor_[static_cast<std::size_t>(bus_count_)] = open_can_interface(bus.name);
      watch(descriptor_[static_cast<std::size_t>(bus_count_++)]);
    }
  } catch (...) {
    for (int bus = 0; bus < bus_count_; ++bus) close(descriptor_[static_cast<std::size_t>(bus)]);
    throw;
  }
}

SocketCanBus::~SocketCanBus() {
  for (int bus = 0; bus < bus_count_; ++bus) close(descriptor_[static_cast<std::size_t>(bus)]);
}

SendResult SocketCanBus::send(int bus, const CanFrame& frame) noexcept {
  const can_frame raw = to_kernel(frame);
  if (write(descriptor_[static_cast<std::size_t>(bus)], &raw, sizeof raw) == static_cast<ssize_t>(sizeof raw)) {
    if (book().stats(bus).state == BusState::kDown) book().stats(bus).state = BusState::kActive;
    book().count_sent(bus, frame);
    return SendResult::kOk;
  }
  if (errno == ENOBUFS || errno == EAGAIN) {
    book().count_refused(bus, frame, false);
    return SendResult::kQueueFull;
  }
  book().stats(bus).state = BusState::kDown;
  return SendResult::kDown;
}

void SocketCanBus::drain() noexcept {
  for (int bus = 0; bus < bus_count_; ++bus) drain_bus(bus);
}

void SocketCanBus::drain_bus(int bus) noexcept {
  can_frame raw{};
  for (;;) {
    const ssize_t size = read(descriptor_[static_cast<std::size_t>(bus)], &raw, sizeof raw);
    if (size < 0 && errno == EINTR) continue;
    if (size < 0 && errno != EAGAIN) book().stats(bus).state = BusState::kDown;
    if (size != static_cast<ssize_t>(sizeof raw)) return;
    book().store(bus, from_kernel(raw, now_us()));
  }
}

}  // namespace liana::bus
