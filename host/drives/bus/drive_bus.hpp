// One interface to all CAN buses of a robot, whatever carries them: SocketCAN, or the embedded bus in lockstep or in
// real time.
//
// One tick, in this order:
//   start = bus.begin_tick(k); bus.write_sync(); bus.send(...)  // SYNC, then what else belongs to the start of a tick
//   bus.wait_feedback(n); while (bus.receive(received)) ...      // what came in since the last tick
//   bus.send(...); bus.end_tick();                               // the targets
// After open nothing allocates, takes a lock or throws; the only system calls are those of the sockets and the deadline
// timer.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "host/base/clock/tick_start.hpp"
#include "host/base/clock/time_mode.hpp"
#include "host/drives/bus/can_frame.hpp"
#include "host/model/config/config.hpp"

namespace liana::bus {

constexpr int kMaxDriveBuses = 8;

// What became of a frame.
enum class SendResult : std::uint8_t {
  kOk,
  kQueueFull,  // the transmit queue had no room (ENOBUFS); the frame is lost and counted as refused
  kDown        // the bus is gone
};

// The state of one bus as its controller sees it.
enum class BusState : std::uint8_t { kActive, kErrorPassive, kBusOff, kDown };

// A received frame and its bus.
struct ReceivedFrame {
  int bus = 0;
  CanFrame frame;
};

// Counters since open, of one bus.
struct DriveBusStats {
  BusState state = BusState::kActive;
  std::uint64_t sent = 0;      // frames accepted for transmission
  std::uint64_t received = 0;  // frames received
  std::uint64_t bits = 0;      // of both, exact stuffing and interframe space included
  std::uint64_t errors = 0;    // error frames
  std::uint64_t refused = 0;   // own frames that found the transmit queue full
  std::uint64_t dropped = 0;   // received frames lost because nobody fetched them in time
};

class DriveBus {
 public:
  virtual ~DriveBus() = default;
  DriveBus() = default;
  DriveBus(const DriveBus&) = delete;
  DriveBus& operator=(const DriveBus&) = delete;

  virtual int bus_count() const noexcept = 0;
  virtual timing::TimeMode time_mode() const noexcept = 0;
  // Waits for the start of tick `tick` (they start at 0 and grow). In real time a tick whose deadline has passed is not
  // caught up with.
  virtual timing::TickStart begin_tick(std::uint64_t tick) noexcept = 0;
  // Queues a frame on bus 0..bus_count()-1.
  virtual SendResult send(int bus, const CanFrame& frame) noexcept = 0;
  // Waits until `expected_tpdos` PDO frames (COB-ID 0x181..0x1FF, 0x381..0x3FF) have come in since begin_tick, or half
  // the period has passed.
  virtual void wait_feedback(int expected_tpdos) noexcept = 0;
  // Fetches the next frame, oldest first; false when there is none.
  virtual bool receive(ReceivedFrame& received) noexcept = 0;
  // Hands everything queued to the wire. The tick is over.
  virtual void end_tick() noexcept = 0;
  // Counters of bus 0..bus_count()-1.
  virtual const DriveBusStats& stats(int bus) const noexcept = 0;
  // Time since tick 0 [us].
  virtual std::uint64_t now_us() const noexcept = 0;

  // Queues SYNC (0x080, no data) on every bus, back to back; the worst result of all.
  SendResult write_sync() noexcept;
  // Share of the wire of `bus` used since tick 0, 0..1.
  double measured_load(int bus, std::int32_t bitrate) const noexcept;
};

// Opens the buses of the table. `bus_socket` is the path of liana-bus; unused for the socketcan backend.
// Throws std::runtime_error saying what is missing and what to do: no such interface (and which exist), interface down,
// kernel without CAN, transmit queue too short, virtual time asked of SocketCAN, nobody listening at bus_socket, or a
// bus process that runs another table.
std::unique_ptr<DriveBus> open_drive_bus(const config::BusesConfig& config, timing::TimeMode mode,
                                         const std::string& bus_socket);

}  // namespace liana::bus
