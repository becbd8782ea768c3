#include "host/drives/commissioning/desk.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "host/drives/canopen/cob_id.hpp"
#include "host/drives/canopen/messages.hpp"

namespace liana::commissioning {
namespace {

constexpr double kScanAnswer_s = 0.3;
constexpr double kMasterHeartbeat_s = 0.35;

}  // namespace

std::uint32_t Answer::value() const {
  std::uint32_t out = 0;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, bytes.size()); ++i)
    out |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  return out;
}

Desk::Desk(const config::BusesConfig& buses, timing::TimeMode time, const std::string& bus_socket,
           const std::atomic<bool>& interrupt)
    : Desk(bus::open_drive_bus(buses, time, bus_socket), buses.rate_hz, interrupt) {}

Desk::Desk(std::unique_ptr<bus::DriveBus> bus, double rate_hz, const std::atomic<bool>& interrupt)
    : rate_hz_(rate_hz), interrupt_(interrupt), bus_(std::move(bus)) {}

std::uint64_t Desk::ticks(double seconds) const {
  return static_cast<std::uint64_t>(std::max(1.0, std::ceil(seconds * rate_hz_)));
}

void Desk::refuse_when_interrupted() const {
  if (interrupt_) throw CommissioningInterrupted("interrupted; nothing more is asked or told");
}

void Desk::tick(const OnFrame& take, const std::function<void()>& send) {
  refuse_when_interrupted();
  exchange(Tick::kQuiet, take, send);
}

void Desk::exchange(Tick kind, const OnFrame& take, const std::function<void()>& send) {
  const timing::TickStart start = bus_->begin_tick(tick_);
  if (start.ended) throw std::runtime_error("the bus has ended: is liana-bus still running?");
  tick_ = start.tick + 1;  // what was missed is not caught up with
  if (kind == Tick::kCyclic) bus_->write_sync();
  bus_->wait_feedback(kind == Tick::kCyclic ? 1 : 0);
  bus::ReceivedFrame received;
  while (bus_->receive(received)) take(received);
  send();
  bus_->end_tick();
}

Answer Desk::finish(Place place, canopen::SdoClient& client) {
  const auto take = [&](const bus::ReceivedFrame& received) {
    const canopen::FrameRoute from = canopen::route(received.frame.id);
    if (received.bus == place.bus && from.kind == canopen::FrameKind::kSdoResponse && from.node == place.node)
      client.on_response(received.frame);
  };
  const auto send = [&] {
    client.tick();
    bus::CanFrame frame;
    while (client.take_request(frame)) bus_->send(place.bus, frame);
  };
  do tick(take, send);
  while (client.status() == canopen::SdoStatus::kBusy);
  return {client.status(),
          client.abort_code(),
          {client.data().begin(), client.data().end()},
          client.said_bytes() != 0,
          client.odd_length()};
}

Answer Desk::read(Place place, std::uint16_t index, std::uint8_t sub) {
  canopen::SdoClient client(place.node, static_cast<std::uint32_t>(ticks(kAnswer_s)));
  client.start_upload(index, sub);
  return finish(place, client);
}

Answer Desk::write(Place place, std::uint16_t index, std::uint8_t sub, std::span<const std::uint8_t> bytes) {
  canopen::SdoClient client(place.node, static_cast<std::uint32_t>(ticks(kAnswer_s)));
  client.start_download(index, sub, bytes);
  return finish(place, client);
}

std::vector<Place> Desk::scan(std::uint8_t first, std::uint8_t last) {
  std::vector<Place> found;
  const auto take = [&](const bus::ReceivedFrame& received) {
    const canopen::FrameRoute from = canopen::route(received.frame.id);
    if (from.kind != canopen::FrameKind::kSdoResponse || from.node < first || from.node > last) return;
    const auto same = [&](const Place& each) { return each.bus == received.bus && each.node == from.node; };
    if (std::none_of(found.begin(), found.end(), same)) found.push_back({received.bus, from.node});
  };
  for (int node = first; node <= last; ++node) {
    canopen::SdoClient client(static_cast<std::uint8_t>(node), 2);
    client.start_upload(0x1000, 0);
    bus::CanFrame frame;
    client.take_request(frame);
    tick(take, [&] {
      for (int b = 0; b < bus_->bus_count(); ++b) bus_->send(b, frame);
    });
  }
  for (std::uint64_t left = ticks(kScanAnswer_s); left > 0; --left) tick(take, [] {});
  std::sort(found.begin(), found.end(),
            [](const Place& a, const Place& b) { return std::pair(a.bus, a.node) < std::pair(b.bus, b.node); });
  return found;
}

std::unique_ptr<canopen::BootNode> Desk::look_at_boot(const canopen::ExpectedDrive& drive) {
  auto node = std::make_unique<canopen::BootNode>(drive, canopen::boot_timing(rate_hz_, drive.type.times), true);
  work_through(*node, canopen::NodePhase::kConfigured);
  return node;
}

std::unique_ptr<canopen::BootNode> Desk::boot(const canopen::ExpectedDrive& drive) {
  auto node = std::make_unique<canopen::BootNode>(drive, canopen::boot_timing(rate_hz_, drive.type.times));
  work_through(*node, canopen::NodePhase::kOperational);
  return node;
}

void Desk::work_through(canopen::BootNode& node, canopen::NodePhase end) {
  const auto take = [&](const bus::ReceivedFrame& received) {
    const canopen::FrameRoute from = canopen::route(received.frame.id);
    if (received.bus != node.bus() || from.node != node.node()) return;
    if (from.kind == canopen::FrameKind::kSdoResponse) node.on_sdo_response(received.frame);
    if (from.kind == canopen::FrameKind::kHeartbeat) node.on_heartbeat(received.frame);
  };
  const auto send = [&] {
    if (end == canopen::NodePhase::kOperational) node.allow_start();
    bus::CanFrame frame;
    if (node.step(frame)) node.sent(bus_->send(node.bus(), frame) == bus::SendResult::kOk);
  };
  while (node.phase() != end && node.phase() != canopen::NodePhase::kFailed) tick(take, send);
}

bool Desk::hears_master() {
  bool heard = false;
  const auto take = [&](const bus::ReceivedFrame& received) {
    const canopen::FrameRoute from = canopen::route(received.frame.id);
    heard = heard || (from.kind == canopen::FrameKind::kHeartbeat && from.node == canopen::kMasterNode);
  };
  for (std::uint64_t left = ticks(kMasterHeartbeat_s); left > 0 && !heard; --left) tick(take, [] {});
  return heard;
}

void Desk::wait(double seconds) {
  for (std::uint64_t left = ticks(seconds); left > 0; --left) tick([](const bus::ReceivedFrame&) {}, [] {});
}

}  // namespace liana::commissioning
