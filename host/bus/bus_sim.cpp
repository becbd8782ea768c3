#include "host/bus/bus_sim.hpp"

#include <algorithm>
#include <utility>

namespace liana {

BusSim::BusSim(std::vector<WireConfig> wires, std::uint32_t period_us, int participants, FaultScript script, FrameSink& sink)
    : wires_(std::move(wires)), lines_(wires_.size()), period_us_(period_us), script_(std::move(script)), sink_(sink) {
  for (Line& line : lines_) line.queues.resize(static_cast<std::size_t>(participants));
}

bool BusSim::queue(int participant, int bus, const CanFrame& frame) {
  Line& line = lines_[static_cast<std::size_t>(bus)];
  if (!line.queues[static_cast<std::size_t>(participant)].push(frame)) {
    ++line.stats.refused;
    return false;
  }
  if (frame.id == kSyncId) ++syncs_under_way_;
  return true;
}

void BusSim::arbitrate(std::uint64_t now_ns) {
  for (std::size_t bus = 0; bus < lines_.size(); ++bus) {
    if (!lines_[bus].busy) start_next(bus, now_ns);
  }
}

void BusSim::start_next(std::size_t bus, std::uint64_t now_ns) {
  Line& line = lines_[bus];
  TransmitQueue* winner = nullptr;
  for (TransmitQueue& queue : line.queues) {
    if (queue.empty() || (winner != nullptr && queue.next_key() >= winner->next_key())) continue;
    winner = &queue;
    line.sender = static_cast<int>(&queue - line.queues.data());
  }
  if (winner == nullptr) return;
  line.frame = winner->pop();
  const std::uint32_t bits = frame_bits(line.frame);
  line.end_ns = now_ns + std::uint64_t{bits} * 1'000'000'000 / wires_[bus].bitrate;
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

void BusSim::finish(std::uint64_t now_ns) {
  for (std::size_t bus = 0; bus < lines_.size(); ++bus) {
    if (lines_[bus].busy && lines_[bus].end_ns <= now_ns) end_frame(bus, now_ns);
  }
}

void BusSim::end_frame(std::size_t bus, std::uint64_t now_ns) {
  Line& line = lines_[bus];
  line.busy = false;
  if (line.frame.id == kSyncId) --syncs_under_way_;
  const std::uint64_t now_us = now_ns / 1000;
  line.frame.time_us = now_us;
  const bool dropped = script_.drops(static_cast<int>(bus), line.frame.id, now_us / period_us_);
  if (dropped) ++line.stats.dropped;
  sink_.frame_ended({static_cast<int>(bus), line.sender, line.frame, dropped});
}

}  // namespace liana
