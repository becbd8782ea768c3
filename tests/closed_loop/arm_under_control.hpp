// The real core in a loop with the plant: drives answer as CiA 402 wants, and telecommands come every T_c.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "firmware_like/cable_controller.hpp"
#include "plant.hpp"

namespace liana::closed_loop {

// Truth against a commanded pose.
struct TruthError {
  double joint_deg = 0.0;  // largest of all angles
  double tip_mm = 0.0;
  double tip_deg = 0.0;
};

class ArmUnderControl {
 public:
  // A path: what to ask for at `share` (0..1) of the time.
  using Path = std::function<cable::Setpoint(double share)>;
  // Called after every tick.
  using Observer = std::function<void(ArmUnderControl&)>;

  // Plant and core with drives off; `told` names the friction that the core believes (empty: the plant's physics).
  explicit ArmUnderControl(const PlantSetup& setup, const std::string& told = "");
  // The same with a table that need not be the shipped one.
  ArmUnderControl(const PlantSetup& setup, const cable::RobotParams& table);

  // Homing, enable, pretension ramp; throws std::runtime_error with the first fault when the arm is not enabled in 10
  // s.
  void boot();
  // Off again: brakes closed, drives without power.
  void disable();
  // Asks for this in the next tick.
  void ask(Request request) { in_.request = request; }
  // The drive sends nothing from now on, and its brake has closed.
  void lose_drive(std::size_t drive);
  // One tick.
  void step();
  // Ticks with no new telecommand.
  void wait(double seconds);
  // One telecommand every T_c along `path`.
  void follow(double seconds, const Path& path, const Observer& observer = {});
  // One interval with this telecommand, or none.
  void interval(const cable::Telecommand& telecommand, const Observer& observer = {});
  // Minimum jerk in joint space to `goal_rad`.
  void move_joints(const cable::ThetaVector& goal_rad, double seconds, const Observer& observer = {});
  // From the next telecommand of move_joints and hold on.
  void carry(const cable::TipLoad& payload) { payload_ = payload; }
  // Asks for where the arm is commanded to be, again and again.
  void hold(double seconds, const Observer& observer = {});

  const cable::Outputs& outputs() const { return out_; }
  const cable::Inputs& inputs() const { return in_; }
  const cable::Controller& controller() const { return controller_; }
  Plant& plant() { return plant_; }
  const cable::RobotParams& table() const { return table_; }
  TruthError error_against(const cable::ThetaVector& theta_rad) const;
  TruthError error_against_command() const { return error_against(out_.theta_command_rad); }

 private:
  void read_drives();
  void answer(std::size_t drive, std::uint16_t controlword);
  cable::CableVector targets_m() const;

  cable::RobotParams table_;
  cable::CableVector zero_payout_m_{};
  cable::CableVector jig_m_{};  // path of the built arm at the zero pose beyond the table's: a jig has seen it
  Plant plant_;
  cable::Controller controller_;
  cable::Inputs in_{};
  cable::Outputs out_{};
  std::array<bool, cable::kMaxCables> gone_{};  // drives
  cable::TipLoad payload_{};
  std::uint64_t sequence_ = 0;
};

}  // namespace liana::closed_loop
