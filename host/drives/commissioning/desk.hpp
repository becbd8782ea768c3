// A CANopen master for one drive on a desk: it asks and tells objects and looks at a boot; what moves a motor is in
// jog_run.hpp. It ticks at the rate of the bus table; every call returns after the answer or its time-out.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/drives/bus/drive_bus.hpp"
#include "host/drives/canopen/boot_node.hpp"

namespace liana::commissioning {

// A node on a bus of the table, and which of its axes is meant.
struct Place {
  int bus = 0;
  std::uint8_t node = 1;
  std::uint8_t axis = 1;
};

constexpr double kAnswer_s = 1.0;  // a drive has for each SDO transfer

// What came of one SDO transfer.
struct Answer {
  canopen::SdoStatus status = canopen::SdoStatus::kIdle;  // kDone, kAborted or kTimeout
  std::uint32_t abort_code = 0;
  std::vector<std::uint8_t> bytes;         // read
  bool has_size = false;                   // the drive said how many bytes they are
  std::optional<std::uint8_t> odd_length;  // kTimeout: bytes of an answer that is none, since it has not 8
  bool is_done() const { return status == canopen::SdoStatus::kDone; }
  std::uint32_t value() const;  // of the first four bytes
};

// The user wants to end.
struct CommissioningInterrupted : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Desk {
 public:
  // Throws std::runtime_error as open_drive_bus does. `interrupt` ends every wait with CommissioningInterrupted.
  Desk(const config::BusesConfig& buses, timing::TimeMode time, const std::string& bus_socket,
       const std::atomic<bool>& interrupt);

  // On a bus that is open already, at so many ticks a second.
  Desk(std::unique_ptr<bus::DriveBus> bus, double rate_hz, const std::atomic<bool>& interrupt);

  // Reads or writes an object of the node, whatever axis; an answer may take 1 s.
  Answer read(Place place, std::uint16_t index, std::uint8_t sub);
  Answer write(Place place, std::uint16_t index, std::uint8_t sub, std::span<const std::uint8_t> bytes);
  // The nodes from `first` to `last` of all buses that answer when asked for 0x1000, in this order; 0.3 s for a node.
  std::vector<Place> scan(std::uint8_t first, std::uint8_t last);
  // Resets communication of the node and goes through its boot, reading only. The result is kConfigured or kFailed.
  std::unique_ptr<canopen::BootNode> look_at_boot(const canopen::ExpectedDrive& drive);
  // Boots the node as lianad does, writing, to kOperational or kFailed. Nothing gives it torque.
  std::unique_ptr<canopen::BootNode> boot(const canopen::ExpectedDrive& drive);
  // Whether another master's heartbeat (0x77F) is heard within 0.35 s.
  bool hears_master();
  // Lets `seconds` pass.
  void wait(double seconds);

  using OnFrame = std::function<void(const bus::ReceivedFrame&)>;
  enum class Tick : std::uint8_t { kQuiet, kCyclic };  // kCyclic: begins with SYNC, and waits for one report
  // One tick, also when interrupted, for who has to bring a motor to rest first: what has come in goes to `take`; what
  // `send` makes goes out. Throws std::runtime_error when the bus has ended.
  void exchange(Tick kind, const OnFrame& take, const std::function<void()>& send);
  // Throws CommissioningInterrupted when the user wants to end.
  void refuse_when_interrupted() const;
  bool is_interrupted() const { return interrupt_; }
  bus::DriveBus& bus() { return *bus_; }
  double rate_hz() const { return rate_hz_; }
  std::uint64_t ticks(double seconds) const;
  // Of the bus so far; may be asked from another thread, which sees so whether anything goes on.
  std::uint64_t tick_count() const { return tick_; }

 private:
  void tick(const OnFrame& take, const std::function<void()>& send);
  void work_through(canopen::BootNode& node, canopen::NodePhase end);
  Answer finish(Place place, canopen::SdoClient& client);

  double rate_hz_;
  const std::atomic<bool>& interrupt_;
  std::unique_ptr<bus::DriveBus> bus_;
  std::atomic<std::uint64_t> tick_ = 0;
};

}  // namespace liana::commissioning
