// The wires of the embedded bus: who may send, how long a frame takes, who gets it. Knows virtual time, no clock and no sockets.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "host/bus/fault_script.hpp"
#include "host/bus/transmit_queue.hpp"

namespace liana {

constexpr std::uint64_t kNeverNs = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint32_t kSyncId = 0x080;

// Name and speed of one wire.
struct WireConfig {
  std::string name;
  std::uint32_t bitrate = 0;  // bit/s
};

// Counters of one wire.
struct WireStats {
  std::uint64_t frames = 0;  // that went over the wire, dropped ones included
  std::uint64_t bits = 0;
  std::uint64_t refused = 0;
  std::uint64_t dropped = 0;
};

// A frame that has just ended.
struct EndedFrame {
  int bus = 0;
  int sender = 0;
  CanFrame frame;  // time_us = its end
  bool dropped = false;
};

// Told of every frame that ends.
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void frame_ended(const EndedFrame& ended) = 0;
};

class BusSim {
 public:
  BusSim(std::vector<WireConfig> wires, std::uint32_t period_us, int participants, FaultScript script, FrameSink& sink);

  // Puts a frame into the queue of `participant` on `bus`; false when it is full.
  bool queue(int participant, int bus, const CanFrame& frame);
  // Every idle wire takes the pending frame of highest priority, at `now_ns`.
  void arbitrate(std::uint64_t now_ns);
  // When the next frame ends; kNeverNs when all wires are idle.
  std::uint64_t next_end_ns() const;
  // Ends the frames whose end is `now_ns`.
  void finish(std::uint64_t now_ns);
  // SYNC frames that are queued or on a wire.
  int syncs_under_way() const { return syncs_under_way_; }

  const std::vector<WireConfig>& wires() const { return wires_; }
  const WireStats& stats(std::size_t bus) const { return lines_[bus].stats; }

 private:
  struct Line {
    std::vector<TransmitQueue> queues;  // by participant
    bool busy = false;
    int sender = 0;
    CanFrame frame;
    std::uint64_t end_ns = kNeverNs;
    WireStats stats;
  };
  void start_next(std::size_t bus, std::uint64_t now_ns);
  void end_frame(std::size_t bus, std::uint64_t now_ns);

  std::vector<WireConfig> wires_;
  std::vector<Line> lines_;
  std::uint32_t period_us_;
  FaultScript script_;
  FrameSink& sink_;
  int syncs_under_way_ = 0;
};

}  // namespace liana
