#include "host/drives/bus_simulator/bus_hub.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cstring>
#include <ctime>
#include <utility>

#include "firmware_like/drive/pdo.hpp"
#include "host/drives/bus_simulator/bus_listener.hpp"

namespace liana::bus_simulator {

BusHub::BusHub(const BusHubOptions& options, std::vector<Participant> participants)
    : participants_(std::move(participants)),
      sim_(options.wires, options.period_us, static_cast<int>(participants_.size()), options.script, *this),
      period_us_(options.period_us) {
  for (const WireConfig& wire : options.wires) {
    if (!options.log_directory.empty()) logs_.emplace_back(options.log_directory, wire.name);
  }
}

wire::Welcome welcome_of(const BusHubOptions& options) {
  wire::Welcome welcome;
  welcome.time_mode = static_cast<std::uint8_t>(options.time_mode);
  welcome.bus_count = static_cast<std::uint8_t>(options.wires.size());
  welcome.period_us = options.period_us;
  for (std::size_t b = 0; b < options.wires.size(); ++b) {
    welcome.bus[b].bitrate = options.wires[b].bitrate;
    std::strncpy(welcome.bus[b].name.data(), options.wires[b].name.c_str(), welcome.bus[b].name.size() - 1);
  }
  return welcome;
}

void BusHub::wait_readable(std::uint64_t timeout_ns) {
  std::array<pollfd, 2> watched{};
  for (std::size_t i = 0; i < participants_.size(); ++i) watched[i] = {participants_[i].descriptor(), POLLIN, 0};
  const timespec timeout{static_cast<time_t>(timeout_ns / 1'000'000'000),
                         static_cast<long>(timeout_ns % 1'000'000'000)};
  ppoll(watched.data(), participants_.size(), &timeout, nullptr);
  if (bus_stop_requested()) end("stopped by a signal");
}

bool BusHub::read_yield(std::size_t index, bool block) {
  Participant& participant = participants_[index];
  switch (participant.receive(block)) {
    case Participant::Received::kYield:
      return true;
    case Participant::Received::kNothing:
      return false;
    case Participant::Received::kGone:
      end(participant.name() + " left");
      return false;
    case Participant::Received::kMalformed:
      participant.refuse("malformed packet; expected is YIELD as in docs/reference/bus-protocol.md");
      end(participant.name() + " sent a malformed packet");
  }
  return false;
}

void BusHub::queue_yield(std::size_t index) {
  Participant& participant = participants_[index];
  const wire::Yield& yield = participant.yield();
  for (std::size_t i = 0; i < yield.frame_count; ++i) {
    wire::Frame frame = yield.frame[i];
    if (frame.bus >= sim_.wires().size() || frame.length > 8) {
      participant.refuse("frame for bus " + std::to_string(frame.bus) + " with " + std::to_string(frame.length) +
                         " bytes; allowed are buses 0 to " + std::to_string(sim_.wires().size() - 1) +
                         " and 0 to 8 bytes");
      return end(participant.name() + " sent a malformed frame");
    }
    if (sim_.queue(static_cast<int>(index), frame.bus, wire::to_can_frame(frame), now_ns)) continue;
    frame.time_us = now_ns / 1000;
    frame.flags = wire::kFrameRefused;
    participant.keep(frame);
  }
}

void BusHub::wake(std::size_t index, std::uint8_t flags, bool block) {
  Participant& participant = participants_[index];
  if (!participant.wake(flags, slot(), now_ns / 1000, block)) end(participant.name() + " left");
}

void BusHub::end(const std::string& reason) {
  if (ended()) return;
  end_reason_ = reason;
  for (Participant& each : participants_) each.wake(wire::kWakeShutdown, slot(), now_ns / 1000, false);
}

// Who stands still hears no more than fits the buffer of its socket.
void BusHub::frame_ended(const EndedFrame& ended) {
  if (ended.dropped) return;
  if (!logs_.empty()) logs_[static_cast<std::size_t>(ended.bus)].write(ended.frame);
  for (std::size_t i = 0; i < participants_.size(); ++i) {
    const bool is_controller = i == kController;
    if (static_cast<int>(i) == ended.sender || (is_controller && !ended.heard_by_controller)) continue;
    if (awake_from_ns(i) > now_ns && participants_[i].frames() >= wire::kMaxPacketFrames) continue;
    participants_[i].keep(wire::to_wire_frame(is_controller ? ended.controller_bus : ended.bus, ended.frame));
    if (ended.frame.id == kSyncCobId) participants_[i].note_sync(now_ns);
  }
}

void BusHub::error_state_changed(int bus, const bus::CanFrame& error_frame) {
  if (!logs_.empty()) logs_[static_cast<std::size_t>(bus)].write(error_frame);
  participants_[kController].keep(wire::to_wire_frame(bus, error_frame));
}

void BusHub::link_changed(int bus, bool is_up) {
  wire::Frame told;
  told.time_us = now_ns / 1000;
  told.bus = static_cast<std::uint8_t>(bus);
  told.length = 1;
  told.flags = wire::kFrameLink;
  told.data[0] = is_up ? 1 : 0;
  participants_[kController].keep(told);
}

std::uint64_t BusHub::awake_from_ns(std::size_t index) const {
  const std::uint64_t from_slot = index == kController ? sim_.script().awake_from(slot()) : slot();
  return from_slot == slot() ? now_ns : from_slot * period_us_ * 1000;
}

}  // namespace liana::bus_simulator
