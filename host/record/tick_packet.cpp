#include "host/record/tick_packet.hpp"

#include <stdexcept>

#include "host/record/codec.hpp"
#include "host/record/image.hpp"
#include "host/record/serialise.hpp"

namespace liana {

std::string tick_packet(const TickRecord& record, std::uint64_t dropped) {
  std::string out;
  out.reserve(16 + serialised_inputs_size() + serialised_outputs_size());
  Writer writer(out);
  writer("kind", TickPacket::kTick);
  writer("dropped", dropped);
  append_serialised(out, record.inputs);
  append_serialised(out, record.outputs);
  return out;
}

namespace {

std::string image_head(std::uint64_t next_tick, bool fresh, const cable::RobotTable& table) {
  std::string out;
  Writer writer(out);
  writer("kind", TickPacket::kImage);
  writer("next_tick", next_tick);
  writer("fresh", static_cast<std::uint8_t>(fresh));
  append_serialised(out, table);
  return out;
}

}  // namespace

std::string image_packet(std::uint64_t next_tick, const cable::RobotTable& table) {
  return image_head(next_tick, true, table);
}

std::string image_packet(std::uint64_t next_tick, const cable::Controller& controller) {
  std::string out = image_head(next_tick, false, controller.table());
  append_state(out, controller);
  return out;
}

TickParts split_tick_packet(std::string_view packet) {
  constexpr std::size_t kHead = 9;
  if (packet.size() != kHead + serialised_inputs_size() + serialised_outputs_size()) {
    throw std::runtime_error("tick packet of " + std::to_string(packet.size()) +
                             " bytes: lianad and archive are of different versions");
  }
  TickParts parts;
  Reader reader(packet.substr(1));
  reader("dropped", parts.dropped);
  parts.inputs = packet.substr(kHead, serialised_inputs_size());
  parts.outputs = packet.substr(kHead + serialised_inputs_size());
  return parts;
}

TickPacket tick_packet_kind(std::string_view packet) {
  const char first = packet.empty() ? '\0' : packet[0];
  if (first != static_cast<char>(TickPacket::kTick) && first != static_cast<char>(TickPacket::kImage)) {
    throw std::runtime_error("unknown packet on topic tick");
  }
  return static_cast<TickPacket>(first);
}

}  // namespace liana
