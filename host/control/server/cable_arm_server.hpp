// The desk of a cable arm: homing by the lengths found, shapes, the slit, and operators' devices.
#pragma once

#include "host/control/arbiter/cable_arbiter.hpp"
#include "host/control/arbiter/shape_progress.hpp"
#include "host/control/clearance_bound/live_clearance.hpp"
#include "host/control/server/device_manager.hpp"
#include "host/control/server/homing.hpp"
#include "host/control/server/recovery.hpp"
#include "host/control/server/typed_arm_server.hpp"
#include "host/control/virtual_fixtures/felt_scene.hpp"
#include "host/control/virtual_fixtures/pitch_budget.hpp"
#include "host/model/config/config.hpp"

namespace liana::server {

// Angles in degrees, as many as the arm has.
std::vector<double> theta_deg(const cable::RobotParams& table, const cable::ThetaVector& theta_rad);

class CableArmServer final : public TypedArmServer<cable::CableArm, arbiter::CableArbiter> {
 public:
  // `devices`: where it listens for them. `in_pose`: the named pose in which the arm lies at the start; empty: nobody
  // knows (homing.hpp, which throws).
  CableArmServer(const config::RobotConfig& robot, const config::SceneConfig& scene, const std::string& in_pose,
                 timing::TimeMode time_mode, realtime::ArmMailbox<cable::CableArm>& link,
                 const device::DeviceEndpoint& devices);

  // From now on no fixture guides a hand or is felt, whatever is asked for; walls forbid in any case.
  void leave_out_fixtures() { has_fixtures_ = false; }

  void watch(bool booted) override;
  void restore_way(const arbiter::KeptWay& kept) override {
    if (!kept.points.empty()) homing_.remember(kept.points.back().joint_rad);
    TypedArmServer::restore_way(kept);
  }
  const NotHomed& not_homed() const override { return homing_.not_homed(); }
  std::string why_not_clear(std::int64_t whole) override;
  std::string why_not_recover() const override;
  bool recovers() const override;
  std::vector<std::size_t> lost() const override;
  void call_whole(std::size_t cable) override;
  std::string why_not_taut() const override;
  bool is_untrue() const override;
  int devices_fd() const override { return devices_.fd(); }
  void hear_devices(std::int64_t now_us) override { devices_.hear(now_us); }
  void take_samples() override;
  void tell_devices(std::int64_t now_us) override;
  Json ask(const MotionRequest& request) override;
  std::optional<LastVerdict> release_next(bool may_release, std::uint32_t owner) override;
  void take_observation(const CameraObservation& picture) override;
  void drop_motion() override;
  std::vector<event::Event> take_events() override;
  void add_state(Json& state) const override;
  void add_drive_state(std::size_t drive, Json& state) const override;

 private:
  std::vector<double> joints_deg(const cable::Outputs& outputs) const override;
  LossView loss() const { return {table_, outputs(), link_.image.value().controller.arm().release(), names_}; }
  void watch_loss();
  void watch_clearance();
  cable::ThetaVector believed_rad() const;
  virtual_fixtures::Sight sight() const;
  std::optional<virtual_fixtures::PitchBudget> pitch_budget() const;
  double tip_room_m() const;
  Json guidance_json() const;
  void foresee(const clearance_bound::Outlook& outlook);
  Json clearance_json() const;
  void move_line(const api::Arguments& fields);
  void hold_theta(const std::vector<api::Arguments>& held);
  void shape(const api::Arguments& fields);
  void carry(const api::Arguments& fields);
  void use_device(const api::Arguments& fields);
  void note_grip();
  virtual_fixtures::PlaneSlots::Told haptic_planes();
  virtual_fixtures::Choice chosen_fixtures(const api::Arguments& fields) const;
  void tell_device(std::vector<event::Event>& events);
  void tell_load_cells(std::vector<event::Event>& events);

  config::RobotConfig robot_;
  config::SceneConfig scene_;
  config::DriveNames names_;
  std::vector<std::size_t> called_whole_;  // cables, by whoever cleared their fault
  Homing homing_;
  arbiter::ShapeProgress shape_progress_;
  std::optional<clearance_bound::LiveClearance> clearance_;  // while the lengths of its cables tell where the arm is
  clearance_bound::Outlook outlook_;                         // what the simulation was told last
  DeviceManager devices_;
  DeviceState device_state_;
  virtual_fixtures::PlaneSlots plane_slots_;
  virtual_fixtures::HandMap grip_;     // that the device was told the planes of last
  std::optional<Pose> predicted_tip_;  // at the end of the command released last
  bool friction_is_off_ = false;       // as told last
  std::uint32_t load_cells_lost_ = 0;  // as told last
  bool device_is_slow_ = false;        // as told last
  bool has_fixtures_ = true;
  std::string feedback_ = "aligned";  // law of use_device
  std::int32_t planar_segments_ = 0;  // how many the slit asks for now (host/model/inverse_kinematics/dof_split.hpp)
};

}  // namespace liana::server
