#include "host/storage/recording/tick_packet.hpp"

#include <stdexcept>

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/image.hpp"
#include "host/storage/recording/serialise.hpp"

namespace liana::recording {

template <class Arm>
std::string tick_packet(const TickRecord<Arm>& record, std::uint64_t dropped, const RecordedCounts& counts) {
  std::string inputs, out;
  append_recorded(inputs, record.inputs, counts);
  out.reserve(16 + inputs.size() + serialised_outputs_size<Arm>());
  Writer writer(out);
  writer("kind", TickPacket::kTick);
  writer("dropped", dropped);
  writer("drives", counts.drives);
  writer("thetas", counts.thetas);
  writer("segments", counts.segments);
  writer("load_cells", counts.load_cells);
  writer("inputs_bytes", static_cast<std::uint32_t>(inputs.size()));
  out += inputs;
  append_recorded(out, record.outputs, counts);
  return out;
}

namespace {

template <class Table>
std::string image_head(std::uint64_t next_tick, bool fresh, const Table& table) {
  std::string out;
  Writer writer(out);
  writer("kind", TickPacket::kImage);
  writer("next_tick", next_tick);
  writer("fresh", static_cast<std::uint8_t>(fresh));
  append_serialised(out, table);
  return out;
}

}  // namespace

template <class Arm>
std::string image_packet(std::uint64_t next_tick, const typename Arm::Table& table) {
  return image_head(next_tick, true, table);
}

template <class Arm>
std::string image_packet(std::uint64_t next_tick, const Controller<Arm>& controller) {
  std::string out = image_head(next_tick, false, controller.table());
  append_state(out, controller);
  return out;
}

TickParts split_tick_packet(std::string_view packet) {
  TickParts parts;
  std::uint32_t inputs_bytes = 0;
  Reader reader(packet.substr(1));
  reader("dropped", parts.dropped);
  reader("drives", parts.counts.drives);
  reader("thetas", parts.counts.thetas);
  reader("segments", parts.counts.segments);
  reader("load_cells", parts.counts.load_cells);
  reader("inputs_bytes", inputs_bytes);
  const bool fits = parts.counts.drives <= kMaxDrives && parts.counts.thetas <= cable::kMaxTheta &&
                    parts.counts.segments <= cable::kMaxSegments && parts.counts.load_cells <= kMaxDrives &&
                    inputs_bytes < reader.left();
  if (!fits) {
    throw std::runtime_error("tick packet of " + std::to_string(packet.size()) +
                             " bytes: lianad and archive are of different versions");
  }
  const std::string_view content = packet.substr(1 + reader.position());
  parts.inputs = content.substr(0, inputs_bytes);
  parts.outputs = content.substr(inputs_bytes);
  return parts;
}

TickPacket tick_packet_kind(std::string_view packet) {
  const char first = packet.empty() ? '\0' : packet[0];
  if (first != static_cast<char>(TickPacket::kTick) && first != static_cast<char>(TickPacket::kImage)) {
    throw std::runtime_error("unknown packet on topic tick");
  }
  return static_cast<TickPacket>(first);
}

#define LIANA_PACKETS(Arm)                                                                        \
  template std::string tick_packet(const TickRecord<Arm>&, std::uint64_t, const RecordedCounts&); \
  template std::string image_packet<Arm>(std::uint64_t, const Arm::Table&);                       \
  template std::string image_packet<Arm>(std::uint64_t, const Controller<Arm>&);
LIANA_PACKETS(cable::CableArm)
LIANA_PACKETS(serial::SerialArm)
#undef LIANA_PACKETS

template <class Arm>
ControllerSnapshot<Arm> parse_image(std::string_view data, const std::string& source) {
  ControllerSnapshot<Arm> image;
  std::uint8_t fresh = 0;
  Reader reader(data);
  reader("next_tick", image.next_tick);
  reader("fresh", fresh);
  if (fresh > 1)
    throw std::runtime_error("recording " + source + ": controller image: field fresh: " + std::to_string(fresh) +
                             "; allowed is 0..1; take a good copy of the file");
  image.fresh = fresh != 0;
  const std::string_view rest = data.substr(reader.position());
  std::size_t used = 0;
  image.table = checked_table<typename Arm::Table>(rest, source, used);
  image.state = rest.substr(used);
  return image;
}

template ControllerSnapshot<cable::CableArm> parse_image(std::string_view, const std::string&);
template ControllerSnapshot<serial::SerialArm> parse_image(std::string_view, const std::string&);

}  // namespace liana::recording
