// A cable-driven arm as the Controller sees it (arm.hpp): from drive lengths and tensions to angles, and from a
// setpoint back to drive targets.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware_like/cable/arm/body_inertia.hpp"
#include "firmware_like/cable/arm/cable_monitor.hpp"
#include "firmware_like/cable/arm/contact_detector.hpp"
#include "firmware_like/cable/arm/dither.hpp"
#include "firmware_like/cable/arm/estimator.hpp"
#include "firmware_like/cable/arm/feed_monitor.hpp"
#include "firmware_like/cable/arm/friction_estimator.hpp"
#include "firmware_like/cable/arm/let_go.hpp"
#include "firmware_like/cable/arm/load_cell.hpp"
#include "firmware_like/cable/arm/setpoint.hpp"
#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/cable/arm/tension.hpp"
#include "firmware_like/cable/arm/tension_monitor.hpp"
#include "firmware_like/cable/motion/damping.hpp"
#include "firmware_like/cable/motion/motion.hpp"
#include "firmware_like/cable/report.hpp"
#include "firmware_like/drive/drive_io.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"
#include "firmware_like/safety/gate.hpp"
#include "firmware_like/safety/supervisor.hpp"

namespace liana::cable {

constexpr double kPretensionRamp_s = 3.0;     // from the tensions found to the planned ones
constexpr std::uint32_t kPlanTicks = 5;       // tensions are planned anew, and reached evenly until then
constexpr std::uint32_t kPlanTick = 2;        // of them: one that has nothing to do with the shape
constexpr double kPayload_s = 0.4;            // time constant with which a payload that was told comes into force
constexpr double kAheadOver_N = 8.0;          // over the floor, of an arm that plans 40 N: below, nothing is foreseen
constexpr double kSlackCheckShare = 0.5;      // of the tension floor: every cable must reach it before the arm may move
constexpr std::uint32_t kHomingTicks = 25;    // the estimate has to stand still this long
constexpr double kHomingStep_rad = 2e-4;      // largest Gauss-Newton step of a converged estimate
constexpr double kHomingResidual_m = 1.5e-3;  // more is a wrong zero, a swapped cable or a slack one

class CableArm {
 public:
  using Table = RobotParams;
  using Setpoint = cable::Setpoint;
  using Report = cable::Report;
  using Sensors = LoadCells;

  // The table must have passed the loader; no other checks are made here.
  explicit CableArm(const RobotParams& table) noexcept;

  const RobotParams& table() const noexcept { return table_; }
  GateLimits gate_limits() const noexcept;
  LinkLimits link_limits() const noexcept;

  // One tick, in the order of these functions; arm.hpp says what each has to do.
  void read(const DriveFeedbacks& drives, const LoadCells& cells) noexcept;
  void watch_drive(WatchScope scope, bool follows, std::int32_t drive, Watch& out) noexcept {
    if (drive >= first_cable_) [[likely]] {
      const TensionReading now{tension_measured_N_[as_index(drive)], estimator_.tension_N[as_index(drive)], follows};
      const WatchScope looked_for{scope.powered, scope.prepared && !may_be_slack(let_go_, layout_, drive)};
      watch_tension(tension_watch_limits_, looked_for, now, drive, tension_watch_, out);
      if (tension_watch_.slack_ticks[as_index(drive)] != 0 && is_missed(tension_watch_limits_, now)) missed_ = drive;
      if ((cables_with_cells_ >> as_index(drive) & 1u) != 0) watch_load_cell(table_, scope, drive, load_cells_, out);
    } else {
      const Index i = as_index(drive);
      watch_feed(table_, scope, feed_[i], tension_.load_Nm[i], drive, tension_watch_, out);
    }
    if (drive == 0) watch_body(scope, out);
  }
  bool lets_go(std::int32_t) const noexcept { return is_behind(let_go_); }
  void watch(WatchScope scope, std::uint64_t tick, FaultList& faults) noexcept;
  ArmStatus status() const noexcept;
  void answer(Request request, const FaultList& faults) noexcept {
    if (!live_) answer_loss(table_, layout_, request, faults, let_go_);
  }
  bool accepts(const Setpoint& setpoint) const noexcept {
    return is_usable(table_, setpoint) &&
           (setpoint.dither_share == 0.0 || dither_fits(table_, tension_.motor_N, setpoint.dither_share));
  }
  void take(const Setpoint& setpoint) noexcept {
    if (is_motion(setpoint.kind)) payload_ = setpoint.payload;
    accept_setpoint(table_, setpoint, motion_);
  }
  void brake() noexcept { motion_.braking = true; }
  bool is_braking() const noexcept { return motion_.braking; }
  void stand() noexcept;
  std::uint32_t advance(bool allowed) noexcept;
  std::uint32_t propose(const Orders& orders, const DriveCommands& sent, bool tensions_valid,
                        DriveProposals& out) noexcept;
  void report(Report& out) const noexcept;

  // What the twin's drives show beside what they are told: the planned tension, or what moves a base.
  static std::int16_t planned_permille(const RobotParams& table, const Report& report, std::int32_t drive) noexcept {
    const Index i = as_index(drive);
    const double force_N =
        drive < table.feed_count() ? feed_force_N(table, drive, report.load_Nm[i]) : report.tension_plan_N[i];
    return narrow<std::int16_t>(to_counts(force_N / table.drive[i].newtons_per_permille).value);
  }

  static bool is_torque_controlled(const RobotParams&) noexcept { return false; }
  // And their load cells, from the last tick's: what was usable says the planned tension, what was not goes on being
  // none.
  static void predict_sensors(const RobotParams& table, const Report& report, LoadCells& cells) noexcept;

  // Motion stage, for the verifier's predictions and for tests.
  const MotionState& motion() const noexcept { return motion_; }
  // The cable that the arm does without, and what is released with it.
  const SegmentReleaseState& release() const noexcept { return let_go_; }
  // Angles and contradictions that the drives' lengths show.
  const EstimatorState& estimator() const noexcept { return estimator_; }

  // Shows `v(name, member)` every member that the table alone does not give, in a fixed order (controller.hpp).
  template <class V>
  void visit_state(V& v) {
    visit_members(*this, v);
  }
  template <class V>
  void visit_state(V& v) const {
    visit_members(*this, v);
  }

 private:
  template <class Self, class V>
  static void visit_members(Self& self, V& v) {
    v("payout_measured_m", self.payout_measured_m_);
    v("tension_measured_N", self.tension_measured_N_);
    v("load_cells", self.load_cells_);
    v("estimator", self.estimator_);
    v("homing_ticks", self.homing_ticks_);
    v("feedback_age_ticks", self.feedback_age_ticks_);
    v("tension_watch", self.tension_watch_);
    v("cable_watch", self.cable_watch_);
    v("friction", self.friction_);
    v("inertia", self.inertia_);
    v("balance", self.balance_);
    v("contact", self.contact_);
    v("planned_mu", self.table_.friction_mu);
    v("tip_load", self.table_.tool);
    v("payload", self.payload_);
    v("motion", self.motion_);
    v("slip", self.slip_);
    v("model", self.model_);
    v("wrap_rad", self.wrap_rad_);
    v("ratio", self.ratio_);
    v("damping", self.damping_);
    v("lift_N", self.lift_N_);
    v("taut_N", self.taut_N_);
    v("static_load_Nm", self.static_load_Nm_);
    v("plan_rate_rad_s", self.plan_rate_rad_s_);
    v("let_go", self.let_go_);
    v("lets_out", self.lets_out_);
    v("tension", self.tension_);
    v("tension_change_N", self.tension_change_N_);
    v("planned_N", self.planned_N_);
    v("load_change_Nm", self.load_change_Nm_);
    v("planned_Nm", self.planned_Nm_);
    v("dither", self.dither_);
    v("pull_N", self.pull_N_);
    v("payout_command_m", self.payout_command_m_);
    v("ramp_start_m", self.ramp_start_m_);
    v("ramp", self.ramp_);
    v("live", self.live_);
  }

  using Index = std::size_t;

  void watch_missed(std::uint64_t tick, FaultList& faults) noexcept;
  bool is_moving() const noexcept;
  void forget_balance() noexcept;
  void watch_balance(std::uint64_t tick, const FaultList& faults) noexcept;
  void balance_next_axis(std::uint64_t tick) noexcept;
  void watch_body(WatchScope scope, Watch& out) const noexcept;
  bool is_homed() const noexcept { return homing_ticks_ >= kHomingTicks; }
  std::int16_t slack_cable() const noexcept;
  void read_cells(const LoadCells& cells) noexcept;
  void count_homing() noexcept;
  void take_geometry() noexcept;
  void keep_slip() noexcept;
  void stop_planning() noexcept;
  void start_ramp(const DriveCommands& sent) noexcept;
  // Dear work is spread over the ticks of the shape's cycle, which has been counted on when they ask.
  bool shape_worked() const noexcept {
    return motion_.shape.tick == kFollowTick + 1 || motion_.shape.tick == kSolveTick + 1;
  }
  bool plans_now() const noexcept { return !live_ || motion_.shape.tick % kPlanTicks == kPlanTick; }
  void aim_tensions(const TensionPlan& plan) noexcept;
  ThetaVector inertia_load_Nm() noexcept;
  void follow_payload() noexcept;
  void take_planned_tensions() noexcept;
  void govern() noexcept;
  void look_at_static_load() noexcept;
  std::uint32_t plan_tensions(bool plans_now, bool tensions_valid) noexcept;
  void dither(bool tensions_valid) noexcept;
  void ramp_payouts(CableVector& wanted_m) const noexcept;
  void damp_payouts(bool tensions_valid, CableVector& wanted_m) noexcept;
  void wind_beyond_ceiling(CableVector& wanted_m) const noexcept;
  void keep_loose() noexcept;
  void let_out(CableVector& wanted_m) const noexcept;
  std::uint32_t limit_payout_speed(CableVector& wanted_m) const noexcept;
  void take_told_tensions(const CableVector& asked_m, const CableVector& told_m) noexcept;
  void propose_payouts(DriveProposals& out) const noexcept;
  Index cables() const noexcept { return static_cast<Index>(layout_.cable_count); }
  Index first_cable() const noexcept { return static_cast<Index>(first_cable_); }

  // As loaded, but for friction_mu, which the arm plans with, and the tool, which is all that hangs at the tip now.
  RobotParams table_{};
  double declared_mu_ = 0.0;
  TipLoad declared_tool_{};
  CableLayout layout_{};
  std::int32_t first_cable_ = 0;  // after the drives of a base that feeds
  std::uint32_t cables_with_cells_ = 0;
  TensionWatchLimits tension_watch_limits_{};
  CableWatchLimits cable_watch_limits_{};
  TorqueLimits torque_limits_{};
  CableVector zero_payout_m_{};

  // What the drives say.
  CableVector payout_measured_m_{};
  FeedReadings feed_{};               // of this tick, read and watched in it
  CableVector tension_measured_N_{};  // by load cell where there is one that is believed, else by torque
  LoadCellState load_cells_{};
  EstimatorState estimator_{};
  std::uint32_t homing_ticks_ = 0;
  std::uint16_t feedback_age_ticks_ = 0xFFFF;  // of the drive that was heard longest ago
  TensionMonitorState tension_watch_{};
  CableMonitorState cable_watch_{};
  FrictionEstimatorState friction_{};
  BodyInertiaState inertia_{};
  TorqueBalance balance_{};
  ContactDetectorState contact_{};

  // Where the arm is told to go, and what it carries there.
  MotionState motion_{};
  TipLoad payload_{};

  // How the cables take it there.
  SlipState slip_{};
  CableModel model_{};        // at the commanded angles
  SegmentVector wrap_rad_{};  // bend along each segment, as old as the tension plan
  TensionRatio ratio_{};      // planned friction
  DampingState damping_{};
  SegmentVector lift_N_{};          // pulled tighter than planned
  CableVector taut_N_{};            // the same of single cables
  ThetaVector static_load_Nm_{};    // what weight and springs take, when tensions were planned last
  ThetaVector plan_rate_rad_s_{};   // commanded, when tensions were planned last
  SegmentReleaseState let_go_{};    // cables of a segment that has lost one
  std::int32_t missed_ = -1;        // cable, found by watch_drive and judged by watch in the same tick; else -1
  bool winds_in_ = false;           // loose cables; found by watch in the same tick
  bool lets_out_ = false;           // drums have somewhere to go yet
  TensionPlan tension_{};           // in force
  CableVector tension_change_N_{};  // of it in each tick until the next plan
  CableVector planned_N_{};         // of the last plan
  ThetaVector load_change_Nm_{}, planned_Nm_{};  // the same of the load
  DitherState dither_{};
  CableVector pull_N_{};  // planned, with the dither in it
  CableVector payout_command_m_{};
  CableVector ramp_start_m_{};  // measured: where the ramp began; while targets are not live, where the motors stand
  double ramp_ = 0.0;           // 0..1 share of the planned pretension
  bool live_ = false;           // targets were live in the last tick
};

static_assert(std::is_trivially_copyable_v<CableArm>);

}  // namespace liana::cable
