// The desk of a serial arm: plain motion of joints and tip, pushes by force control; absolute encoders say where it is.
#pragma once

#include "host/control/arbiter/serial_arbiter.hpp"
#include "host/control/server/typed_arm_server.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::server {

class SerialArmServer final : public TypedArmServer<serial::SerialArm, arbiter::SerialArbiter> {
 public:
  SerialArmServer(const config::SerialRobotConfig& robot, const config::SceneConfig& scene, timing::TimeMode time_mode,
                  realtime::ArmMailbox<serial::SerialArm>& link);

  void watch(bool booted) override;
  const NotHomed& not_homed() const override { return not_homed_; }
  void drop_motion() override { arbiter_.hold(); }
  void add_state(Json& state) const override;
  void add_drive_state(std::size_t drive, Json& state) const override;

 private:
  std::vector<double> joints_deg(const serial::Outputs& outputs) const override;

  void tell_adapter(const api::Arguments& fields);

  config::SerialRobotConfig robot_;
  std::uint8_t adapter_sequence_ = 0;
  NotHomed not_homed_;
};

}  // namespace liana::server
