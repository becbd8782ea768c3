// A serial arm as the Controller sees it (arm.hpp): absolute encoders in, joint targets of position-controlled drives
// out; or, where the table says so, rates and torques of torque-controlled ones, and pushes by force control.
#pragma once

#include <cstdint>
#include <type_traits>

#include "firmware_like/drive/drive_io.hpp"
#include "firmware_like/safety/supervisor.hpp"
#include "firmware_like/serial/drive_units.hpp"
#include "firmware_like/serial/joint_friction.hpp"
#include "firmware_like/serial/joint_monitor.hpp"
#include "firmware_like/serial/motion.hpp"
#include "firmware_like/serial/report.hpp"
#include "firmware_like/serial/setpoint.hpp"
#include "firmware_like/serial/torque_drive.hpp"

namespace liana::serial {

constexpr std::uint32_t kHomingTicks = 25;  // encoders have to be heard and plausible this long

class SerialArm {
 public:
  using Table = RobotParams;
  using Setpoint = serial::Setpoint;
  using Report = serial::Report;
  using Sensors = serial::Sensors;

  // The table must have passed the loader; no other checks are made here.
  explicit SerialArm(const RobotParams& table) noexcept;

  const RobotParams& table() const noexcept { return table_; }
  GateLimits gate_limits() const noexcept { return make_gate_limits(table_); }
  LinkLimits link_limits() const noexcept { return make_link_limits(table_); }

  // One tick, in the order of these functions; arm.hpp says what each has to do.
  void read(const DriveFeedbacks& drives, const Sensors& sensors) noexcept;
  void watch_drive(WatchScope scope, bool follows, std::int32_t drive, Watch& out) noexcept;
  void watch(WatchScope scope, std::uint64_t tick, FaultList& faults) noexcept;
  bool lets_go(std::int32_t) const noexcept { return false; }  // a joint never gives in
  ArmStatus status() const noexcept;
  void answer(Request, const FaultList&) noexcept {}  // nothing is kept for a clear
  bool accepts(const Setpoint& setpoint) const noexcept { return is_usable(table_, setpoint); }
  void take(const Setpoint& setpoint) noexcept;
  void brake() noexcept { motion_.braking = true; }
  bool is_braking() const noexcept { return motion_.braking; }
  void stand() noexcept;
  std::uint32_t advance(bool allowed) noexcept;
  std::uint32_t propose(const Orders& orders, const DriveCommands& sent, bool tensions_valid,
                        DriveProposals& out) noexcept;
  void report(Report& out) const noexcept;

  // What the twin's drives show beside what they are told: nothing, in orbit and without a load.
  static std::int16_t planned_permille(const RobotParams&, const Report&, std::int32_t) noexcept { return 0; }

  static bool is_torque_controlled(const RobotParams& table) noexcept { return table.torque.is_torque_controlled != 0; }
  // The sensors that the twin imagines for the next tick, from the last one's.
  static void predict_sensors(const RobotParams&, const Report&, Sensors& sensors) noexcept {
    serial::predict_sensors(sensors);
  }

  // Motion stage, for the verifier's predictions and for tests.
  const MotionState& motion() const noexcept { return motion_; }

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
    v("joints", self.joints_);
    v("torque_measured_Nm", self.torque_measured_Nm_);
    v("homing_ticks", self.homing_ticks_);
    v("motion", self.motion_);
    v("wrist", self.wrist_);
    v("adapter", self.adapter_);
    v("push", self.push_);
    v("told", self.told_);
    v("payload", self.payload_);
    v("friction", self.friction_);
  }

  JointVector measured_rad() const noexcept;
  ForceMotion give_way(bool allowed) noexcept;
  ForceMotion lead() noexcept;

  RobotParams table_{};
  JointMonitorState joints_{};
  JointVector torque_measured_Nm_{};
  std::uint32_t homing_ticks_ = 0;
  MotionState motion_{};
  Dynamics dynamics_;
  WristState wrist_{};
  AdapterState adapter_{};
  InsertState push_{};
  TorqueTold told_{};
  FrictionFound friction_;
  LinkMass payload_{};  // at the tip, as the newest setpoint that moves the arm says
};

static_assert(std::is_trivially_copyable_v<SerialArm>);

}  // namespace liana::serial
