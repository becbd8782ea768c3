#include "host/drives/bus_simulator/bus_sim.hpp"
#include "firmware_like/drive/pdo.hpp"

#include <algorithm>
#include <utility>

namespace liana::bus_simulator {

BusSim::BusSim(std::vector<WireConfig> wires, std::uint32_t period_us, int participants, FaultScript script,
               FrameSink& sink)
    : wires_(std::move(wires)),
      lines_(wires_.size()),
      connectors_(wires_.size()),
      period_us_(period_us),
      script_(std::move(script)),
      sink_(sink) {
  for (Line& line : lines_) line.queues.resize(static_cast<std::size_t>(participants));
  for (const BusFault& fault : script_.faults()) {
    if (fault.action == BusAction::kSend) strangers_.push_back({fault.bus, fault.frame, 0});
  }
}

bool BusSim::queue(int participant, int bus, const bus::CanFrame& frame, std::uint64_t now_ns) {
  const std::uint64_t slot = slot_at(now_ns);
  const int across = script_.across(bus, slot);
  Line& line = lines_[static_cast<std::size_t>(participant == kController ? across : bus)];
  if (participant == kController && !takes_part(bus)) return true;  // as Linux does: accepted, and gone
  if (participant != kController && script_.lasts(BusAction::kCut, across, slot)) {
    ++line.stats.dropped;
    return true;
  }
  const bool refused = participant == kController && script_.takes(BusAction::kRefuse, bus, frame.id, slot);
  if (!refused && line.queues[static_cast<std::size_t>(participant)].push(frame)) return true;
  ++line.stats.refused;
  return false;
}

// A controller in bus-off neither sends nor receives.
bool BusSim::takes_part(int connector) const {
  const Connector& end = connectors_[static_cast<std::size_t>(connector)];
  return !end.is_down && end.errors.state() != ErrorState::kBusOff;
}

void BusSim::arbitrate(std::uint64_t now_ns) {
  now_us_ = now_ns / 1000;
  for (; slots_begun_ <= slot_at(now_ns); ++slots_begun_) begin_slot(slots_begun_);
  for (std::size_t bus = 0; bus < lines_.size(); ++bus) {
    if (!lines_[bus].busy) start_next(bus, now_ns);
  }
}

void BusSim::begin_slot(std::uint64_t slot) {
  std::size_t stranger = 0;
  for (const BusFault& fault : script_.faults()) {
    const bool lasts = slot >= fault.from_slot && slot <= fault.to_slot;
    if (fault.action == BusAction::kSend) strangers_[stranger++].pending = lasts ? strangers_frames(fault) : 0;
    if (fault.action == BusAction::kDown && slot == fault.from_slot) set_link(fault.bus, false);
    if (fault.action == BusAction::kDown && slot == fault.to_slot + 1) set_link(fault.bus, true);
    if (fault.action == BusAction::kRestart && slot == fault.from_slot)
      report(fault.bus, connectors_[static_cast<std::size_t>(fault.bus)].errors.restart());
  }
}

std::uint32_t BusSim::strangers_frames(const BusFault& fault) const {
  if (fault.load_percent == 0) return 1;
  const std::uint64_t bits =
      std::uint64_t{wires_[static_cast<std::size_t>(fault.bus)].bitrate} * period_us_ / 1'000'000;
  return static_cast<std::uint32_t>(bits * static_cast<std::uint64_t>(fault.load_percent) / 100 /
                                    bus::frame_bits(fault.frame));
}

// What was queued is gone, and the error counters begin anew.
void BusSim::set_link(int bus, bool is_up) {
  const int wire = script_.across(bus, slots_begun_);
  lines_[static_cast<std::size_t>(wire)].queues[kController].clear();
  connectors_[static_cast<std::size_t>(bus)] = {ErrorCounters{}, !is_up};
  sink_.link_changed(bus, is_up);
}

void BusSim::report(int connector, std::optional<bus::CanFrame> error_frame) {
  if (!error_frame) return;
  error_frame->time_us = now_us_;
  sink_.error_state_changed(connector, *error_frame);
}

void BusSim::start_next(std::size_t bus, std::uint64_t now_ns) {
  Line& line = lines_[bus];
  TransmitQueue* winner = nullptr;
  for (TransmitQueue& queue : line.queues) {
    if (queue.empty() || (winner != nullptr && queue.next_key() >= winner->next_key())) continue;
    winner = &queue;
    line.sender = static_cast<int>(&queue - line.queues.data());
  }
  for (Stranger& stranger : strangers_) {
    const std::uint32_t key = bus::arbitration_key(stranger.frame);
    if (stranger.bus != static_cast<int>(bus) || stranger.pending == 0 ||
        (winner != nullptr && winner->next_key() <= key))
      continue;
    --stranger.pending;
    line.sender = kStranger;
    line.sending = {key, stranger.frame, true};
    return start(line, wires_[bus], now_ns);
  }
  if (winner == nullptr) return;
  line.sending = winner->pop();
  start(line, wires_[bus], now_ns);
}

void BusSim::start(Line& line, const WireConfig& wire, std::uint64_t now_ns) {
  const bus::CanFrame& frame = line.sending.frame;
  const auto bus = static_cast<int>(&line - lines_.data());
  line.disturbed = line.sender != kStranger && script_.takes(BusAction::kDisturb, bus, frame.id, slot_at(now_ns));
  const std::uint32_t bits = bus::frame_bits(frame) + (line.disturbed ? kErrorFrameBits : 0);
  line.end_ns = now_ns + std::uint64_t{bits} * 1'000'000'000 / wire.bitrate;
  line.busy = true;
  ++line.stats.frames;
  line.stats.bits += bits;
}

std::uint64_t BusSim::next_end_ns() const {
  std::uint64_t next = kNeverNs;
  for (const Line& line : lines_) {
    if (line.busy) next = std::min(next, line.end_ns);
  }
  return next;
}

bool BusSim::is_sync_under_way() const {
  return std::any_of(lines_.begin(), lines_.end(), [](const Line& line) {
    const auto holds_sync = [](const TransmitQueue& queue) { return queue.holds(kSyncCobId); };
    return (line.busy && line.sending.frame.id == kSyncCobId) ||
           std::any_of(line.queues.begin(), line.queues.end(), holds_sync);
  });
}

void BusSim::finish(std::uint64_t now_ns) {
  now_us_ = now_ns / 1000;
  for (std::size_t bus = 0; bus < lines_.size(); ++bus) {
    if (lines_[bus].busy && lines_[bus].end_ns <= now_ns) end_frame(bus, now_ns);
  }
}

void BusSim::end_frame(std::size_t bus, std::uint64_t now_ns) {
  Line& line = lines_[bus];
  line.busy = false;
  const std::uint64_t slot = slot_at(now_ns);
  const auto wire = static_cast<int>(bus);
  const int connector = script_.across(wire, slot);
  const bool is_own = line.sender == kController;
  const bool cut = script_.lasts(BusAction::kCut, connector, slot);
  if (is_own && !takes_part(connector)) return;  // it went down, or into bus-off, in the middle of it
  if (line.disturbed || (is_own && cut)) return fail(line, connector, !cut);
  EndedFrame ended{wire, line.sender, line.sending.frame, false, takes_part(connector) && !cut, connector};
  ErrorCounters& errors = connectors_[static_cast<std::size_t>(connector)].errors;
  if (ended.heard_by_controller) report(connector, is_own ? errors.transmitted() : errors.received());
  ended.frame.time_us = now_us_;
  ended.dropped = script_.takes(BusAction::kDrop, wire, ended.frame.id, slot);
  if (ended.dropped) ++line.stats.dropped;
  const bool again = !line.sending.sent_before && script_.takes(BusAction::kDuplicate, wire, ended.frame.id, slot);
  if (again) line.queues[static_cast<std::size_t>(line.sender)].put_back(line.sending);
  if (line.held.empty() && script_.takes(BusAction::kReorder, wire, ended.frame.id, slot))
    return line.held.push_back(ended);
  hand_over(line, ended);
}

// The frame was destroyed, or nobody acknowledged it: it is sent again, as long as its controller may.
void BusSim::fail(Line& line, int connector, bool was_acknowledged) {
  ++line.stats.disturbed;
  line.queues[static_cast<std::size_t>(line.sender)].put_back(line.sending);
  ErrorCounters& errors = connectors_[static_cast<std::size_t>(connector)].errors;
  if (line.sender == kController) {
    report(connector, was_acknowledged ? errors.transmit_failed() : errors.unacknowledged());
  } else if (takes_part(connector)) {
    report(connector, errors.receive_failed());
  }
  if (errors.state() == ErrorState::kBusOff) line.queues[kController].clear();
}

void BusSim::hand_over(Line& line, const EndedFrame& ended) {
  sink_.frame_ended(ended);
  for (EndedFrame& late : line.held) {
    late.frame.time_us = now_us_;
    sink_.frame_ended(late);
  }
  line.held.clear();
}

}  // namespace liana::bus_simulator
