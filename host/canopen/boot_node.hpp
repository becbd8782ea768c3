// The boot of one node: wait for its boot-up message, work through the plan over SDO, start it.
#pragma once

#include "host/canopen/boot_mismatch.hpp"
#include "host/canopen/boot_plan.hpp"
#include "host/canopen/sdo_client.hpp"

namespace liana::canopen {

// Patience, in ticks, each at least 1.
struct BootTiming {
  std::uint32_t reset_ticks = 0;        // between two resets of a node that does not come up
  std::uint32_t boot_up_ticks = 0;      // until it counts as missing
  std::uint32_t sdo_ticks = 0;          // for one answer
  std::uint32_t start_ticks = 0;        // between two NMT starts of a node that does not say that it is operational
  std::uint32_t operational_ticks = 0;  // from the first of them to the heartbeat that says so
};

// 0.5 s between resets, 10 s in all; 0.3 s per answer; 0.25 s between starts, 1 s to become operational.
BootTiming boot_timing(double rate_hz);

enum class NodePhase : std::uint8_t {
  kReset,
  kWaitBootUp,
  kObjects,
  kConfigured,
  kStart,
  kWaitOperational,
  kOperational,
  kFailed
};

class BootNode {
 public:
  BootNode(const DriveExpectation& drive, const BootTiming& timing);

  int bus() const noexcept { return bus_; }
  std::uint8_t node() const noexcept { return node_; }
  NodePhase phase() const noexcept { return phase_; }
  const BootMismatch& mismatch() const noexcept { return mismatch_; }
  // After its first boot: what 0x1018:4 of the drive says, and must say when it comes back; 0 when it has none.
  std::uint32_t serial() const noexcept { return plan_.serial(); }
  // Objects of the plan that are done, and how many there are.
  std::size_t objects_done() const noexcept { return at_; }
  std::size_t objects_total() const noexcept { return plan_.objects().size(); }

  // All nodes are configured: this one may be started.
  void allow_start() noexcept;
  // One tick has passed; true when `frame` is to be sent, which sent() confirms.
  bool step(bus::CanFrame& frame) noexcept;
  // The frame of the last step() has (or has not) been taken by the bus; if not, it comes again.
  void sent(bool accepted) noexcept;
  // A boot-up message of an operational node begins its plan again, and, when `all_were_operational`, that of a failed
  // one, too: the drive has come back.
  void on_heartbeat(std::uint8_t state, bool all_were_operational) noexcept;
  void on_sdo_response(const bus::CanFrame& frame) noexcept;

 private:
  void enter(NodePhase phase) noexcept;
  void advance() noexcept;
  void send_start() noexcept;
  void begin_object() noexcept;
  void begin_read() noexcept;
  void finish_transfer() noexcept;
  void next_object() noexcept;
  void restart(bool all_were_operational) noexcept;
  void fail(BootFailure failure, std::uint32_t found = 0) noexcept;
  const BootObject& object() const noexcept { return plan_.objects()[at_]; }

  int bus_;
  std::uint8_t node_;
  BootTiming timing_;
  BootPlan plan_;
  SdoClient sdo_;
  NodePhase phase_ = NodePhase::kReset;
  BootMismatch mismatch_;
  std::uint32_t waited_ticks_ = 0;     // in this phase
  std::uint32_t without_boot_up_ = 0;  // since the first reset
  std::size_t at_ = 0;                 // object of the plan
  int attempts_ = 0;                   // at the present transfer
  int restarts_ = 0;
  bool reading_back_ = false;
  std::uint8_t last_state_ = 0xFF;  // NMT state last heard, 0xFF = none
  bus::CanFrame out_;
  bool out_waiting_ = false;
};

}  // namespace liana::canopen
