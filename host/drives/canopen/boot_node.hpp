// The boot of one node: wait for its boot-up message, work through the plan over SDO, start it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "host/drives/canopen/boot_mismatch.hpp"
#include "host/drives/canopen/boot_plan.hpp"
#include "host/drives/canopen/boot_transfer.hpp"
#include "host/drives/canopen/sdo_client.hpp"

namespace liana::canopen {

// Patience, in ticks, each at least 1.
struct BootTiming {
  std::uint32_t reset_ticks = 0;        // from the first reset of a node that does not come up to the second
  std::uint32_t max_reset_ticks = 0;    // each wait is twice the one before, up to this one
  std::uint32_t boot_up_ticks = 0;      // from the first reset until it counts as missing
  std::uint32_t sdo_ticks = 0;          // for one answer
  std::uint32_t start_ticks = 0;        // between two NMT starts of a node that does not say that it is operational
  std::uint32_t operational_ticks = 0;  // from the first of them to the heartbeat that says so
};

// The same in seconds at any rate: resets after 1, 2, 4, 4, ... s (so that a drive whose reset takes 3 s comes up
// between two of them); 0.25 s between starts; the rest is the drive's own allowance.
BootTiming boot_timing(double rate_hz, const config::DriveTimes& allowed = {});

// What is heard of a node that was booted.
enum class NodeSeen : std::uint8_t {
  kWell,            // operational, heartbeats and reports come
  kPreOperational,  // heartbeats come: it kept its node, not its state
  kLost,            // anything else
};

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

constexpr std::size_t kMaxMismatches = 32;  // kept of one node; a wrong drive refuses more than anybody reads

// What came of one object of the plan.
struct BootOutcome {
  std::optional<std::uint32_t> found;  // nothing: not asked for, or the drive has none
  bool is_refused = false;
  std::size_t said_bytes = 0;  // of the object, as the drive says; 0: it does not
};

class BootNode {
 public:
  // All axes of the node. With `look_only` nothing is written to it, and it should not be started.
  BootNode(std::span<const ExpectedDrive> axes, const BootTiming& timing, bool look_only = false);
  BootNode(const ExpectedDrive& drive, const BootTiming& timing, bool look_only = false)
      : BootNode(std::span(&drive, 1), timing, look_only) {}

  int bus() const noexcept { return bus_; }
  std::uint8_t node() const noexcept { return node_; }
  NodePhase phase() const noexcept { return phase_; }
  // What of its plan it refused, and what ended it, last; empty: all is well so far.
  std::span<const BootMismatch> mismatches() const noexcept { return {mismatches_.data(), mismatch_count_}; }
  // How many refusals had no place among them.
  std::uint32_t more_mismatches() const noexcept { return more_mismatches_; }
  // The plan, and what has come of each of its objects so far.
  const BootPlan& plan() const noexcept { return plan_; }
  std::span<const BootOutcome> outcomes() const noexcept { return outcomes_; }
  // Whether the drive has answered for this object of the plan.
  bool has(config::ObjectId object) const noexcept;
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
  // A boot-up message of an operational or a failed node begins its plan again: the drive has come, or come back. (One
  // that kept restarting waits for recover().)
  // A frame on its identifier that has not one byte is no heartbeat, and is named where one was missed.
  void on_heartbeat(const bus::CanFrame& frame) noexcept;
  // Somebody wants the node back (clear). One that is pre-operational works through its plan again, since it may have
  // restarted unheard; one that is lost or has failed is reset first. Nothing happens to one that is well or on its
  // way.
  void recover(NodeSeen seen) noexcept;
  void on_sdo_response(const bus::CanFrame& frame) noexcept;

 private:
  void enter(NodePhase phase) noexcept;
  void advance() noexcept;
  void send_nmt(std::uint8_t command) noexcept;
  void wait_for_boot_up() noexcept;
  void begin_object() noexcept;
  void finish_transfer() noexcept;
  void next_object() noexcept;
  void begin_plan() noexcept;
  void restart() noexcept;
  bool is_missing() const noexcept;
  bool lacks_what_it_needs() const noexcept;
  void refused(BootFailure failure) noexcept;
  void fail(BootFailure failure) noexcept;
  void note(const BootMismatch& mismatch) noexcept;
  void forget_mismatches() noexcept;
  const BootObject& object() const noexcept { return plan_.objects()[at_]; }

  int bus_;
  std::uint8_t node_;
  BootTiming timing_;
  bool look_only_;
  BootPlan plan_;
  std::vector<BootOutcome> outcomes_;  // of the objects of the plan
  SdoClient sdo_;
  BootTransfer transfer_;
  NodePhase phase_ = NodePhase::kReset;
  std::array<BootMismatch, kMaxMismatches> mismatches_{};
  std::size_t mismatch_count_ = 0;
  std::uint32_t more_mismatches_ = 0;
  std::uint32_t waited_ticks_ = 0;     // in this phase
  std::uint32_t reset_wait_ = 0;       // until the next reset
  std::uint32_t without_boot_up_ = 0;  // since the first reset
  std::size_t at_ = 0;                 // object of the plan
  int restarts_ = 0;
  bool is_another_ = false;                    // its identity is not the one expected
  std::optional<std::uint8_t> last_state_;     // byte of its last heartbeat
  std::optional<std::uint8_t> odd_heartbeat_;  // bytes of the last frame in the place of a heartbeat that was none
  bus::CanFrame out_;
  bool out_waiting_ = false;
};

}  // namespace liana::canopen
