// Scripted faults of the embedded bus (docs/reference/bus-protocol.md).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "host/drives/bus/can_frame.hpp"

namespace liana::bus_simulator {

constexpr std::uint64_t kLastSlot = std::numeric_limits<std::uint32_t>::max();

enum class BusAction : std::uint8_t {
  kDrop,       // frames occupy the wire and nobody receives them
  kDuplicate,  // frames are received, and sent again
  kReorder,    // frames are received after the next one
  kDisturb,    // frames are destroyed by an error frame, and sent again
  kRefuse,     // the controller's frames find its transmit queue full
  kSend,       // a stranger sends frames
  kCut,        // the controller's cable is off: nobody acknowledges it, it hears nobody
  kDown,       // the controller's interface is down
  kRestart,    // the controller's interface is restarted after bus-off
  kSwap,       // the controller's cables of two buses are exchanged
  kPause       // the controller is not woken (all buses)
};

// One entry of a script: what happens in the slots from_slot to to_slot, both included.
struct BusFault {
  BusAction action = BusAction::kDrop;
  int bus = 0;
  std::uint64_t from_slot = 0;
  std::uint64_t to_slot = kLastSlot;
  std::optional<std::uint32_t> id = std::nullopt;                   // of the frames meant; nothing = every frame
  std::uint32_t count = std::numeric_limits<std::uint32_t>::max();  // most frames it takes
  int with_bus = 0;                                                 // kSwap: the other one
  bus::CanFrame frame{};                                            // kSend
  int load_percent = 0;                                             // kSend: of the wire; 0 = one frame in each slot
};

class FaultScript {
 public:
  FaultScript() = default;
  explicit FaultScript(std::vector<BusFault> faults) : faults_(std::move(faults)) {}

  // True when `action` meets a frame with this id in `slot`, which it then counts.
  bool takes(BusAction action, int bus, std::uint32_t id, std::uint64_t slot);
  // True when `action` lasts in `slot`.
  bool lasts(BusAction action, int bus, std::uint64_t slot) const;
  // The bus at the controller's connector `bus` in `slot`, and the connector at that bus.
  int across(int bus, std::uint64_t slot) const;
  // The first slot after `slot` in which the controller is not paused; `slot` itself when it is not.
  std::uint64_t awake_from(std::uint64_t slot) const;
  const std::vector<BusFault>& faults() const { return faults_; }

 private:
  std::vector<BusFault> faults_;
};

// Reads a script; throws std::runtime_error naming file, entry, field and what is allowed. Buses are 0..bus_count-1.
FaultScript load_fault_script(const std::string& path, int bus_count);

// The same from the text of a script, which messages call `path`.
FaultScript parse_fault_script(const std::string& text, const std::string& path, int bus_count);

}  // namespace liana::bus_simulator
