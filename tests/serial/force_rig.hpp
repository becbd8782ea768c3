// The real Controller of the small arm on its base against a stand-in plant: flexible chain, torque loops at 1 kHz, a
// payload with pins, the adapter, and a wrist sensor and adapter messages as the bus would bring them. No bus, no
// drives' state machines beyond what enabling needs.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "firmware_like/command/release.hpp"
#include "firmware_like/serial_controller.hpp"
#include "hil/drive/torque_loop.hpp"
#include "hil/serial/adapter.hpp"
#include "hil/serial/flexible_chain.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::test {

// What differs from run to run.
struct ForceCase {
  double payload_kg = 500.0;
  double base_share = 1.0;  // of the base's stiffness
  double gear_share = 1.0;  // of the gears'
  double coulomb_Nm = 8.0;
  bench::AdapterParams adapter{};
  bench::Vec3 aside_m{0.0010, 0.0015, 0.0};  // of the plate from the socket's middle
  bench::Vec3 tilt_rad{0.004, -0.005, 0.0};
  double before_m = 0.001;     // of the plate before the socket's face
  double most_aside_m = 0.02;  // that the push may go
  double noise_N = 0.2;
  bench::Vec3 bias_N{};
  std::uint64_t seed = 1;
  bool never_captures = false;  // the adapter does not say so, and its latch stays open
};

// All that may differ, drawn as the study did (payload study, 4).
ForceCase drawn_case(std::uint64_t seed);

// How far beside the socket's axis a push may begin, in any direction, and how far turned about any axis across it.
struct Misalignment {
  double aside_m;
  double tilt_rad;
};
// The same, begun by up to `most` beside the socket and turned, so far before its face that every pin is clear of its
// funnel.
ForceCase misaligned_case(std::uint64_t seed, const Misalignment& most);

class ForceRig {
 public:
  using Command = Telecommand<serial::Setpoint>;
  // Called with what the sensors say before the Controller sees it.
  using Meddle = std::function<void(serial::Sensors&)>;

  explicit ForceRig(const ForceCase& settings, const std::string& pose = "install");

  // Enables the arm and waits until it stands.
  void enable();
  // One tick of controller and plant; `setpoint` is in force for five ticks, as the arbiter would send it.
  const serial::Outputs& tick(Request request = Request::kNone);
  void run_s(double seconds);
  // From now on this is sent again every interval; none: nothing is sent.
  void ask(const std::optional<serial::Setpoint>& setpoint) { asked_ = setpoint; }
  serial::Setpoint push(double force_N, serial::InsertLaw law = serial::InsertLaw::kForce);

  const serial::Outputs& out() const { return out_; }
  double time_s() const { return static_cast<double>(now_) * robot_.table.tick_s; }
  const config::SerialRobotConfig& robot() const { return robot_; }
  bench::FlexibleChain& chain() { return *chain_; }
  bench::Adapter& adapter() { return adapter_; }
  bench::TipState plate() const;                       // in the socket's frame
  bench::TipLoad contact() const { return contact_; }  // of the adapter on the plate, in the socket's frame
  double axial_N() const { return -contact_.force_N.z; }
  double max_gear_Nm() const;   // of all joints, now
  double base_moved_m() const;  // the tip of the arm that carries, from where it began
  void meddle(const Meddle& meddle) { meddle_ = meddle; }
  // What pushes the tip besides, in the root's frame.
  void push_tip(const bench::TipLoad& load) { outside_ = load; }
  // The socket moves along its axis at this speed, as when the adapter locks.
  void move_socket(double speed_m_s) { socket_m_s_ = speed_m_s; }

 private:
  void read_drives();
  void read_sensors();
  void move_plant();
  bench::TipLoad load_on_tip(const bench::TipState& tip) const;

  ForceCase case_;
  config::SerialRobotConfig robot_;
  bench::SerialRobotConfig model_;
  std::unique_ptr<bench::FlexibleChain> chain_;
  bench::Adapter adapter_;
  bench::Pose socket_in_root_;
  bench::Vec3 base_start_m_;
  std::array<bench::TorqueLoop, 7> loop_{};
  serial::Controller controller_;
  serial::Inputs inputs_{};
  serial::Outputs out_{};
  serial::Sensors sensors_{};
  std::optional<serial::Setpoint> asked_;
  std::uint64_t now_ = 1;
  std::uint64_t sequence_ = 0;
  mutable bench::TipLoad contact_;
  bench::TipLoad outside_;
  double socket_m_s_ = 0.0;
  Meddle meddle_;
  std::uint64_t noise_state_;
  double noise();
};

}  // namespace liana::test
