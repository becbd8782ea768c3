#include "host/control/realtime/sensor_channel.hpp"

#include <algorithm>

#include "firmware_like/math/convert.hpp"
#include "host/drives/canopen/cob_id.hpp"

namespace liana::realtime {

namespace {

constexpr std::uint64_t kTicksBetweenCommands = 4;

std::uint16_t older(std::uint16_t age, std::uint64_t lost) {
  return age == serial::kNeverHeard ? age : narrow<std::uint16_t>(std::uint64_t{age} + 1 + lost);
}

std::span<const std::uint8_t> data_of(const bus::CanFrame& frame) { return {frame.data.data(), frame.length}; }

}  // namespace

SensorChannel::SensorChannel(const config::BusesConfig& buses) {
  for (std::size_t b = 0; b < buses.buses.size(); ++b) {
    const config::BusConfig& bus = buses.buses[b];
    if (bus.wrist_sensor != 0) wrist_ = {static_cast<int>(b), static_cast<std::uint8_t>(bus.wrist_sensor), false};
    for (const config::LoadCellNode& node : bus.load_cells)
      cell_nodes_.push_back({{static_cast<int>(b), static_cast<std::uint8_t>(node.node), false}, node.cables});
    if (bus.adapter != 0) adapter_ = {static_cast<int>(b), static_cast<std::uint8_t>(bus.adapter), false};
  }
}

void SensorChannel::begin_tick(std::uint64_t lost) noexcept {
  sensors_.wrist.age_ticks = older(sensors_.wrist.age_ticks, lost);
  sensors_.adapter.age_ticks = older(sensors_.adapter.age_ticks, lost);
  for (const CellNode& node : cell_nodes_) {
    for (const std::size_t cable : node.cables)
      load_cells_.age_ticks[cable] = older(load_cells_.age_ticks[cable], lost);
  }
}

void SensorChannel::on_heartbeat(int bus, const bus::CanFrame& frame, Node& node) noexcept {
  if (bus != node.bus || frame.id != canopen::kHeartbeatBase + node.id || frame.length != 1) return;
  node.wants_start = frame.data[0] != canopen::kStateOperational;
}

void SensorChannel::on_frame(int bus, const bus::CanFrame& frame) noexcept {
  on_heartbeat(bus, frame, wrist_);
  on_heartbeat(bus, frame, adapter_);
  for (CellNode& node : cell_nodes_) {
    on_heartbeat(bus, frame, node);
    if (bus == node.bus && frame.id == canopen::kTpdo1Base + node.id) take_cells(node, frame);
  }
  serial::WristHalf half;
  if (bus == wrist_.bus && frame.id == canopen::kTpdo1Base + wrist_.id &&
      serial::decode_wrist_half(data_of(frame), serial::kWristForceStep_N, half)) {
    force_ = half;
    take_halves();
  }
  if (bus == wrist_.bus && frame.id == kTpdo2Base + wrist_.id &&
      serial::decode_wrist_half(data_of(frame), serial::kWristTorqueStep_Nm, half)) {
    torque_ = half;
    take_halves();
  }
  if (bus == adapter_.bus && frame.id == canopen::kTpdo1Base + adapter_.id)
    (void)serial::decode_adapter(data_of(frame), sensors_.adapter);
}

// The worse of both states is that of the sample.
void SensorChannel::take_halves() noexcept {
  if (!force_ || !torque_ || force_->sequence != torque_->sequence) return;
  sensors_.wrist = {{force_->value, torque_->value}, force_->sequence, std::max(force_->status, torque_->status), 0};
  force_.reset();
  torque_.reset();
}

// Two bytes a channel, little-endian; a frame of another length says nothing.
void SensorChannel::take_cells(const CellNode& node, const bus::CanFrame& frame) noexcept {
  if (frame.length != 2 * node.cables.size()) return;
  for (std::size_t i = 0; i < node.cables.size(); ++i) {
    const auto word = static_cast<std::uint16_t>(frame.data[2 * i] | frame.data[2 * i + 1] << 8u);
    load_cells_.steps[node.cables[i]] = static_cast<cable::CellSteps>(word);
    load_cells_.age_ticks[node.cables[i]] = 0;
  }
}

void SensorChannel::start(bus::DriveBus& bus, Node& node) noexcept {
  if (!node.wants_start) return;
  bus::CanFrame frame;
  frame.id = canopen::kNmtId;
  frame.length = 2;
  frame.data[0] = canopen::kNmtStart;
  frame.data[1] = node.id;
  if (bus.send(node.bus, frame) == bus::SendResult::kOk)
    node.wants_start = false;  // until the next heartbeat that says so
}

void SensorChannel::step(bus::DriveBus& bus, std::uint64_t tick, serial::AdapterCommand command,
                         std::uint8_t sequence) noexcept {
  start(bus, wrist_);
  start(bus, adapter_);
  for (CellNode& node : cell_nodes_) start(bus, node);
  if (adapter_.bus < 0 || sequence == 0 || tick % kTicksBetweenCommands != 0) return;
  bus::CanFrame frame;
  frame.id = rpdo1_cob_id(adapter_.id);
  frame.length = static_cast<std::uint8_t>(serial::kAdapterCommandBytes);
  const auto bytes = serial::encode_adapter_command(command, sequence);
  std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  bus.send(adapter_.bus, frame);
}

}  // namespace liana::realtime
