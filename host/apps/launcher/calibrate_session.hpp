// lianad, and with a simulated arm bus and bench, with the drives off, read while the arm lies in a fixture.
#pragma once

#include "host/apps/launcher/lockstep_session.hpp"
#include "host/drives/calibration/calibrate.hpp"
#include "host/drives/calibration/load_fit.hpp"
#include "host/drives/calibration/load_poses.hpp"

namespace liana::launcher {

constexpr double kFrictionTurn_deg = 3.0;
constexpr double kFrictionRate_deg_s = 1.0;

class CalibrateSession {
 public:
  // `plan`: without a mission. Both must outlive this.
  CalibrateSession(const SystemLayout& plan, const InterruptGuard& interrupts);

  // Boots the drives and averages what they report for a second; the pose of the result is left empty. Throws
  // std::runtime_error when a drive does not boot or a program ends; Interrupted at Ctrl-C; BadInput when a program
  // refused what it was given.
  calibration::CalibrationReading read();

  // Enables the arm, turns one segment after the other by kFrictionTurn_deg to and fro and the arm back to where it
  // was, and disables it: about three minutes of arm time. Throws as read() does, and when a fault comes.
  calibration::Friction measure_friction(const config::RobotConfig& robot);

  // Enables the arm, goes to every pose from both of its sides and back to where it was, and disables it: about 20 s of
  // arm time a pose. Throws as read() does, when a fault comes, and when lianad refuses a motion.
  calibration::LoadResult measure_load(const config::RobotConfig& robot,
                                       const std::vector<calibration::LoadPose>& poses);

 private:
  void go_to(const std::vector<double>& goal_deg, const config::RobotConfig& robot);
  calibration::LoadReading read_at_rest();
  void disable();

  std::vector<double> at_deg_;  // where the arm was sent last
  LockstepSession session_;
};

}  // namespace liana::launcher
