// lianad, and with a simulated arm bus and bench, with the drives off, read while the arm lies in a fixture.
#pragma once

#include <string>

#include "host/calibration/calibrate.hpp"
#include "host/system/interrupt.hpp"
#include "host/system/system.hpp"

namespace liana::system {

class CalibrateSession {
 public:
  // `plan`: without a mission. Both must outlive this.
  CalibrateSession(const SystemLayout& plan, const InterruptGuard& interrupts);
  // Ends the programs.
  ~CalibrateSession();
  CalibrateSession(const CalibrateSession&) = delete;
  CalibrateSession& operator=(const CalibrateSession&) = delete;

  // Boots the drives and averages what they report for a second; the pose of the result is left empty. Throws
  // std::runtime_error when a drive does not boot or a program ends; Interrupted at Ctrl-C; BadInput when a program
  // refused what it was given.
  calibration::CalibrationReading read();

 private:
  void start();
  Json next_state();
  [[noreturn]] void give_up(const std::string& why, double settle_s = 0.0);

  const InterruptGuard& interrupts_;
  System system_;
};

}  // namespace liana::system
