// The short way of one motor on a desk: enabled, led by a ramp, at rest, disabled. One tick at a time, without a bus:
// reports in, commands out. Every target is judged by JogBounds before it leaves.
#pragma once

#include <cstdint>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/drive/drive_io.hpp"

namespace liana::commissioning {

struct JogRequest {
  double by_counts = 0.0;                // signed way, in increments of the encoder
  double counts_per_s = 1.0;             // fastest, more than 0
  double ramp_s = 0.5;                   // from rest to the fastest, and back
  double window_counts = 1.0;            // farther from its target the motor counts as run away
  double settled_counts = 1.0;           // this near to the goal it has arrived
  double most_torque_permille = 1000.0;  // more than a quarter above it for 0.1 s ends the way
  bool clears_fault = false;             // a drive that has a fault is told to forget it; else it is not enabled
};

// What lets a target out: between start and goal, and not farther from the one before than the ramp can be.
struct JogBounds {
  std::int32_t low = 0;
  std::int32_t high = 0;
  double max_step = 0.0;  // counts
  bool allows(std::int32_t before, std::int64_t target) const noexcept;
};

enum class JogResult : std::uint8_t {
  kNone,           // still on its way
  kArrived,        // it stands at its goal
  kInterrupted,    // somebody wanted it to stop
  kFaultBefore,    // it had a fault before it was enabled, and was not to clear it
  kNotEnabled,     // it did not reach Operation enabled within 5 s
  kFault,          // the drive stopped by itself: Fault, or another state than Operation enabled
  kEmergency,      // it sent an emergency message
  kReportsLost,    // no TPDO for 0.1 s
  kHeartbeatLost,  // no heartbeat for 0.35 s, or one that is not of Operational
  kOtherMode,      // it shows another mode (6061) than it was told
  kRanAway,        // farther from its target than the window
  kTorque,         // it needed more torque than it may have
  kBounds,         // a target was out of bounds: a mistake of this program, and nothing left
  kNotSettled,     // told its goal, it was not there within 2 s
};

class Jog {
 public:
  Jog(const JogRequest& request, double rate_hz);

  // One tick: what has come of the drive (ages of this tick) and what it is told. Before it is enabled the target is
  // where it stands.
  DriveCommand step(const DriveFeedback& seen) noexcept;
  // Somebody wants it to stop: down the ramp, then disabled.
  void interrupt() noexcept;

  // Disabled again, or 2 s were not enough to see it so: is_off() says which.
  bool is_over() const noexcept { return phase_ == Phase::kOver; }
  // The drive itself says that it has no power on the motor.
  bool is_off() const noexcept { return liana::is_off(decode(last_.statusword)) && last_.feedback_age_ticks == 0; }
  JogResult end() const noexcept { return end_; }
  // Where it stood when it was enabled; moved_counts() from there.
  std::int32_t start_counts() const noexcept { return start_; }
  std::int32_t moved_counts() const noexcept;
  bool was_enabled() const noexcept { return was_enabled_; }

 private:
  enum class Phase : std::uint8_t { kEnable, kMove, kSettle, kStop, kDisable, kOver };
  void enter(Phase phase) noexcept;
  void end_with(JogResult why, Phase next) noexcept;
  void enable() noexcept;
  void watch() noexcept;
  void move() noexcept;
  void settle() noexcept;
  void disable() noexcept;
  void tell_target(double target) noexcept;
  DriveGoal goal() const noexcept;
  double ticks(double seconds) const noexcept { return seconds * rate_hz_; }

  JogRequest request_;
  double rate_hz_;
  Phase phase_ = Phase::kEnable;
  JogResult end_ = JogResult::kNone;
  JogBounds bounds_;
  DriveFeedback last_;
  DriveCommand told_;
  std::uint32_t in_phase_ticks_ = 0;
  std::int32_t start_ = 0;
  std::int32_t moved_to_ = 0;  // where it was last while it was enabled, and after
  double target_ = 0.0;        // exact
  double speed_ = 0.0;         // counts/s, along the way
  bool was_enabled_ = false;
  std::uint32_t strained_ticks_ = 0;  // in a row with more torque than it may have
};

}  // namespace liana::commissioning
