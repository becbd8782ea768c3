// One simulated CiA 402 drive: a CANopen node with a motor and a brake (docs/reference/drives.md), or one axis of a
// node. Each axis hears all that the node hears; the first one speaks for the node.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "hil/drive/can_frame.hpp"
#include "hil/drive/cia402.hpp"
#include "hil/drive/defects.hpp"
#include "hil/drive/drive_objects.hpp"
#include "hil/drive/pdo.hpp"
#include "hil/drive/sdo_server.hpp"
#include "hil/drive/servo_motor.hpp"
#include "hil/drive/torque_loop.hpp"

namespace liana::bench {

constexpr int kCyclicSynchronousPosition = 8;  // 6060
constexpr int kCyclicSynchronousTorque = 10;

enum class NmtState : std::uint8_t { kInitialising = 0, kStopped = 4, kOperational = 5, kPreOperational = 0x7F };

// What went over the wire and what the drive did; for the summary.
struct DriveCounts {
  std::uint64_t received = 0;
  std::uint64_t sent = 0;
  std::uint64_t syncs = 0;
  std::uint64_t rpdos = 0;
  std::uint64_t emergencies = 0;
  std::uint64_t quick_stops = 0;
  std::uint64_t sdo_aborts = 0;
};

class Drive {
 public:
  Drive(const DriveSettings& settings, double start_counts);
  Drive(const Drive&) = delete;
  Drive& operator=(const Drive&) = delete;

  // A frame from the bus; what the drive sends in answer is appended to `out`.
  void receive(const CanFrame& frame, FrameList& out);
  // Timers, supervision and the end of ramps; call at least once a SYNC period, after receive().
  void tick(std::uint64_t now_us, FrameList& out);
  // Motor and brake, one physics step under the load.
  void move(double step_s, double load_permille);
  // True while its motor gives torque: then the physics ask for it once a millisecond, tell where the motor is, and do
  // not move it.
  bool is_torque_controlled() const;
  // Motor torque at the joint [N.m] until the next call; `gear_Nm` is the joint torque sensor, the rest the motor's
  // own.
  double torque_Nm(double step_s, double gear_Nm, double position_counts, double velocity_counts_per_s);
  // Where the motor that gives torque is now, for what the drive reports at the next SYNC.
  void carry(double position_counts, double velocity_counts_per_s) {
    if (is_torque_controlled()) motor_.carry(position_counts, velocity_counts_per_s);
  }
  // What the torque sensor reads now [permille of rated], and by how much the reported position is wrong.
  void set_measured(double permille, double position_error_counts = 0.0);

  // Faults from outside.
  DriveDefects& defects() { return defects_; }
  void power_off();  // dead: brake on, nothing heard or sent
  void power_on();   // after power_off(): objects have their power-on values, the next tick() sends the boot-up
  void set_safe_torque_off();  // STO line open: brake on, stays disabled
  void raise_fault(std::uint16_t emergency_code);
  void report_emergency(std::uint16_t code) { emergencies_.push_back(code); }  // sent, and nothing else happens
  void set_identity(std::uint32_t product);
  void leave_other_mode() {  // back to the mode that 6060 says
    defects_.mode.reset();
    objects_.set(0x6061, 0, objects_.get(0x6060));
  }
  void jump_encoder(double counts) {
    encoder_offset_counts_ += counts;
  }  // reads so much more from now on; the servo goes by it

  PowerState power_state() const { return power_; }
  NmtState nmt_state() const { return nmt_; }
  const ServoMotor& motor() const { return motor_; }
  std::uint8_t bus() const { return settings_.bus; }
  int node() const { return settings_.node; }
  DriveCounts counts() const;
  // The statusword as it would be sent.
  std::uint16_t statusword() const;

 private:
  std::uint32_t guard(const Object& object, std::int64_t value) const;
  void written(const Object& object);
  void handle_sdo(const CanFrame& request, FrameList& out);
  bool answers_sdo(const CanFrame& request);
  void send_as_node(NmtState state, FrameList& out);
  void handle_nmt(const CanFrame& frame, FrameList& out);
  void begin_reset(bool of_node, FrameList& out);
  void reset_node();
  void reset_communication(FrameList& out);
  void enter_nmt(NmtState state);
  void handle_sync(FrameList& out);
  void handle_rpdo(const CanFrame& frame, FrameList& out);
  void handle_heartbeat(const CanFrame& frame, FrameList& out);
  void rebuild_pdos();
  void behave_on_lost_heartbeat();
  void lead_to(PowerState state);
  void act_on_controlword(std::uint16_t controlword);
  void enter_power(PowerState state);
  void stop_by_itself();
  bool mode_allows_power() const;
  double rad_per_count() const;
  double Nm_per_permille() const;
  TorqueGains torque_gains() const;
  void change_mode();
  void begin_torque_stop();
  void end_torque();
  bool is_at_rest() const;
  void connection_lost(std::uint16_t code, FrameList& out);
  void connection_back(FrameList& out);
  void supervise_following(std::uint64_t now_us);
  void sample();
  void send_process_data(FrameList& out);
  bool is_due(std::size_t pdo, const CanFrame& sampled) const;
  void send(CanFrame frame, FrameList& out);
  void send_late(FrameList& out);
  void send_emergency(std::uint16_t code, FrameList& out);

  struct Supervised {
    bool armed = false;
    std::uint64_t last_us = 0;
  };

  DriveSettings settings_;
  ObjectDictionary objects_;
  SdoServer sdo_;
  int sdo_axis_ = 1;  // whose object the node's transfer is about
  ServoMotor motor_;
  TorqueLoop torque_loop_;
  std::optional<TorqueStop> torque_stop_;
  std::vector<Pdo> receive_pdos_;
  std::vector<Pdo> transmit_pdos_;
  std::array<std::optional<CanFrame>, kPdoCount> pending_;
  std::array<std::optional<CanFrame>, kPdoCount> last_sent_;  // of each TPDO, since operational
  NmtState nmt_ = NmtState::kInitialising;
  PowerState power_ = PowerState::kSwitchOnDisabled;
  std::uint16_t controlword_ = 0;
  bool dead_ = false;
  bool safe_torque_off_ = false;
  bool connection_lost_ = false;
  bool targets_lost_ = false;  // of it the RPDO half: a heartbeat alone does not bring it back
  DriveDefects defects_;
  std::deque<FrameList> late_;  // sampled, not sent yet
  struct Later {
    std::uint64_t at_us = 0;
    CanFrame frame;
  };
  std::deque<Later> answers_;  // of SDO, not sent yet
  struct Slow {
    PowerState to;
    std::uint64_t at_us;
  };
  std::optional<Slow> transition_;            // under way
  std::optional<std::uint64_t> reset_at_us_;  // a reset is under way, deaf until then
  double measured_permille_ = 0.0;
  double position_error_counts_ = 0.0;
  double encoder_offset_counts_ = 0.0;
  std::uint64_t now_us_ = 0;
  std::uint64_t next_heartbeat_us_ = 0;
  std::uint64_t following_since_us_ = 0;
  bool following_error_ = false;
  Supervised master_;
  Supervised targets_;
  std::vector<std::uint16_t> emergencies_;  // to be sent by the next tick
  DriveCounts counts_;
};

}  // namespace liana::bench
