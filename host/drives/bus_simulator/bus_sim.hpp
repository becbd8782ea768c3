// The wires of the embedded bus: who may send, how long a frame takes, who gets it. Knows virtual time, no clock and no
// sockets.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "host/drives/bus_simulator/error_counters.hpp"
#include "host/drives/bus_simulator/fault_script.hpp"
#include "host/drives/bus_simulator/transmit_queue.hpp"

namespace liana::bus_simulator {

constexpr std::uint64_t kNeverNs = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint32_t kErrorFrameBits = 20;  // two superposed flags and the delimiter
constexpr int kController = 0;                 // participant whose CAN controllers have error states
constexpr int kStranger = -1;                  // sender of scripted frames

// Name and speed of one wire.
struct WireConfig {
  std::string name;
  std::uint32_t bitrate = 0;  // bit/s
};

// Counters of one wire.
struct WireStats {
  std::uint64_t frames = 0;  // that went over the wire, lost and disturbed ones included
  std::uint64_t bits = 0;
  std::uint64_t refused = 0;
  std::uint64_t dropped = 0;
  std::uint64_t disturbed = 0;
};

// A frame that is received now.
struct EndedFrame {
  int bus = 0;             // wire
  int sender = kStranger;  // participant
  bus::CanFrame frame;     // time_us = its end
  bool dropped = false;
  bool heard_by_controller = true;
  int controller_bus = 0;  // at which connector of the controller
};

// Told of what happens on the wires, and of what the controller's own interfaces report (`bus` is then the controller's
// connector).
class FrameSink {
 public:
  virtual ~FrameSink() = default;
  virtual void frame_ended(const EndedFrame& ended) = 0;
  virtual void error_state_changed(int bus, const bus::CanFrame& error_frame) = 0;
  virtual void link_changed(int bus, bool is_up) = 0;
};

class BusSim {
 public:
  BusSim(std::vector<WireConfig> wires, std::uint32_t period_us, int participants, FaultScript script, FrameSink& sink);

  // Puts a frame into the queue of `participant` on `bus`; false when it is full.
  bool queue(int participant, int bus, const bus::CanFrame& frame, std::uint64_t now_ns);
  // Begins the slots up to `now_ns`; every idle wire takes the pending frame of highest priority.
  void arbitrate(std::uint64_t now_ns);
  // When the next frame ends; kNeverNs when all wires are idle.
  std::uint64_t next_end_ns() const;
  // Ends the frames whose end is `now_ns`.
  void finish(std::uint64_t now_ns);
  // True when a SYNC is queued or on a wire.
  bool is_sync_under_way() const;

  const std::vector<WireConfig>& wires() const { return wires_; }
  const WireStats& stats(std::size_t bus) const { return lines_[bus].stats; }
  const FaultScript& script() const { return script_; }

 private:
  struct Line {
    std::vector<TransmitQueue> queues;  // by participant
    bool busy = false;
    int sender = kStranger;
    WaitingFrame sending;
    bool disturbed = false;
    std::uint64_t end_ns = kNeverNs;
    std::vector<EndedFrame> held;  // at most one: received after the next
    WireStats stats;
  };
  // The controller's end of a bus.
  struct Connector {
    ErrorCounters errors;
    bool is_down = false;
  };
  // Scripted frames that still compete for the wire in this slot.
  struct Stranger {
    int bus = 0;
    bus::CanFrame frame;
    std::uint32_t pending = 0;
  };

  std::uint64_t slot_at(std::uint64_t now_ns) const { return now_ns / 1000 / period_us_; }
  void begin_slot(std::uint64_t slot);
  std::uint32_t strangers_frames(const BusFault& fault) const;
  void set_link(int bus, bool is_up);
  void start_next(std::size_t bus, std::uint64_t now_ns);
  void start(Line& line, const WireConfig& wire, std::uint64_t now_ns);
  void end_frame(std::size_t bus, std::uint64_t now_ns);
  void fail(Line& line, int connector, bool was_acknowledged);
  void hand_over(Line& line, const EndedFrame& ended);
  bool takes_part(int connector) const;
  void report(int connector, std::optional<bus::CanFrame> error_frame);

  std::vector<WireConfig> wires_;
  std::vector<Line> lines_;
  std::vector<Connector> connectors_;
  std::vector<Stranger> strangers_;  // one for each kSend of the script
  std::uint32_t period_us_;
  FaultScript script_;
  FrameSink& sink_;
  std::uint64_t now_us_ = 0;
  std::uint64_t slots_begun_ = 0;
};

}  // namespace liana::bus_simulator
