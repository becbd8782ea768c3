// The control core: one door, `tick`. A trivially copyable value, so that the twin is a copy of it.
#pragma once

#include <type_traits>

#include "firmware_like/arm/estimator.hpp"
#include "firmware_like/arm/tension.hpp"
#include "firmware_like/controller_io.hpp"
#include "firmware_like/motion/damping.hpp"
#include "firmware_like/motion/motion.hpp"
#include "firmware_like/safety/cable_watch.hpp"
#include "firmware_like/safety/gate.hpp"
#include "firmware_like/safety/supervisor.hpp"
#include "firmware_like/safety/watchdogs.hpp"

namespace liana {

constexpr double kPretensionRamp_s = 3.0;     // from the tensions found to the planned ones
constexpr double kSlackCheckShare = 0.5;      // of the tension floor: every cable must reach it before the arm may move
constexpr std::uint32_t kHomingTicks = 25;    // the estimate has to stand still this long
constexpr double kHomingStep_rad = 2e-4;      // largest Gauss-Newton step of a converged estimate
constexpr double kHomingResidual_m = 1.5e-3;  // more is a wrong zero, a swapped cable or a slack one

// Everything the core remembers between ticks.
class Controller {
 public:
  // The table must have passed the loader; no other checks are made here.
  explicit Controller(const RobotTable& table) noexcept;

  // One control cycle. Never fails: what is wrong is in the faults and limits of the result. Inputs must come one per tick, in order.
  Outputs tick(const Inputs& inputs) noexcept;

  const RobotTable& table() const noexcept { return table_; }
  // Motion stage, for the verifier's predictions and for tests.
  const MotionState& motion() const noexcept { return motion_; }
  // What the last clear or enable looked at (bits of Condition).
  const SupervisorState& supervisor() const noexcept { return supervisor_; }
  // Angles and contradictions that the drives' lengths show.
  const EstimatorState& estimator() const noexcept { return estimator_; }

 private:
  using Index = std::size_t;

  void read_drives(const Inputs& inputs) noexcept;
  std::int32_t watch_all(const Inputs& inputs) noexcept;
  void take_telecommand(const Inputs& inputs) noexcept;
  void move(const Inputs& inputs, const Orders& orders) noexcept;
  void take_geometry() noexcept;
  void plan_payouts(const Orders& orders) noexcept;
  void command_drives(const Inputs& inputs, const Orders& orders) noexcept;
  Outputs report(const Inputs& inputs, const Orders& orders) const noexcept;

  bool homed() const noexcept { return homing_ticks_ >= kHomingTicks; }
  bool cables_taut() const noexcept;
  void reject_telecommand(const Inputs& inputs) noexcept;
  void ramp_payouts(CableVector& wanted_m) const noexcept;
  void damp_payouts(CableVector& wanted_m) noexcept;
  void limit_payout_speed(CableVector& wanted_m) noexcept;
  Index cables() const noexcept { return static_cast<Index>(layout_.cable_count); }
  Index thetas() const noexcept { return static_cast<Index>(table_.theta_count()); }

  RobotTable table_{};
  CableLayout layout_{};
  GateLimits gate_limits_{};
  WatchdogLimits watchdog_limits_{};
  CableWatchLimits cable_watch_limits_{};

  CableVector zero_payout_m_{};
  CableVector payout_measured_m_{};
  CableVector tension_measured_N_{};
  EstimatorState estimator_{};
  std::uint32_t homing_ticks_ = 0;
  std::uint16_t feedback_age_ticks_ = 0xFFFF;  // of the drive that was heard longest ago

  WatchdogState watchdogs_{};
  CableWatchState cable_watch_{};
  FaultList faults_{};
  SupervisorState supervisor_{};

  Telecommand active_{};
  Telecommand pending_{};
  std::uint64_t last_sequence_ = 0;
  MotionState motion_{};
  std::uint32_t limits_ = 0;
  bool at_rest_ = true;  // nothing moves by command

  SlipState slip_{};
  CableModel model_{};    // at the commanded angles
  TensionRatio ratio_{};  // planned friction
  DampingState damping_{};
  SegmentVector lift_N_{};  // pulled tighter than planned
  TensionPlan tension_{};
  CableVector payout_command_m_{};
  CableVector ramp_start_m_{};
  double ramp_ = 0.0;  // 0..1 share of the planned pretension
  bool live_ = false;  // targets were live in the last tick

  std::array<DriveCommand, kMaxCables> sent_{};
};

static_assert(std::is_trivially_copyable_v<Controller>);

}  // namespace liana
