// A master that boots and enables the torque drives of a TorquePlant frame by frame, with the force law that was found
// to hold on a flexible base; commands act two ticks after what they are made of.
#pragma once

#include <deque>
#include <functional>

#include "firmware_like/serial/kinematics.hpp"
#include "hil/payload/torque_plant.hpp"
#include "tests/payload/payload_tables.hpp"

namespace liana::test {

// What came over the wire, newest.
struct Heard {
  serial::JointVector joint_rad{};
  std::array<int, 7> statusword{};
  std::array<int, 7> torque_permille{};
  bench::Vec3 force_N, torque_Nm;  // of the wrist sensor
  int wrist_status = 0;
  int wrist_frames = 0;
  bool captured = false;
  int latch = 0, lock = 0;
  std::array<double, 3> depth_m{};
  int adapter_frames = 0;
};

// Rates and feed-forward of all joints.
struct TorqueCommand {
  serial::JointVector rate_rad_s{};
  serial::JointVector feed_forward_Nm{};
};

// M_d dv/dt = C_F (F - F_e) - K_D v, v and forces of the payload's plate in the tip's frame; q' = J# v, tau = J^T F_e.
// F_e of the feed-forward is low-passed with 0.1 s: the sensor feels the payload's inertia, too, and fed back at once
// that swings the wrist against the payload at some 8 Hz.
class ForceLaw {
 public:
  ForceLaw(const serial::RobotParams& table, double plate_m) : table_(table), plate_m_(plate_m) {}
  double set_N = 0.0;  // along z
  bool feed_forward = true;
  TorqueCommand step(double tick_s, const serial::JointVector& joint_rad, const bench::Vec3& force_N,
                     const bench::Vec3& torque_Nm);

 private:
  serial::RobotParams table_;
  double plate_m_;
  std::array<double, 6> velocity_{};  // linear, angular
  std::array<double, 6> met_{};       // force and torque, low-passed
};

class Stand {
 public:
  static constexpr double kTick_s = 0.004;

  // `faults` are a fault list as text; the scene is payload_at_adapter unless another is given.
  explicit Stand(std::uint64_t seed, const std::string& faults = "[]", bool spread = true,
                 const Json& scene = scene_table("payload_at_adapter"));

  // One tick; `silent`: the master says nothing.
  void tick(const TorqueCommand& command, bool silent = false);
  // One tick of the law, its sensor tared.
  void press(double set_N, bool unload = false);
  // Boots, enables all drives in torque mode, tares the sensor.
  void start();
  // Sends a frame with the next tick.
  void say(std::uint32_t id, std::vector<std::uint8_t> bytes, std::uint8_t bus);
  double now_s() const { return slot_ * kTick_s; }
  const bench::FaultInjector& injector() const { return injector_; }

  config::SerialRobotConfig robot;
  bench::TorquePlant plant;
  Heard heard;
  int controlword = 0;
  double peak_N = 0.0, peak_Nm = 0.0;  // true: of the contact, of a joint
  bench::FrameList last_out;

 private:
  void configure();
  void hear(const bench::CanFrame& frame);
  void ask(const TorqueCommand& command);

  bench::FaultInjector injector_;
  ForceLaw law_;
  bench::Vec3 tare_N_, tare_Nm_;
  std::deque<bench::FrameList> on_the_way_;
  bench::FrameList extra_;
  std::uint32_t slot_ = 0;
};

}  // namespace liana::test
