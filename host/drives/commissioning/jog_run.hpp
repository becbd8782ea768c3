// A jog on the bus: the drive is booted as its type says, told to move, disabled and left as after a reset of
// communication. The master's heartbeat and SYNC go out meanwhile; a drive that misses them stops by itself.
#pragma once

#include <functional>
#include <optional>

#include "host/drives/canopen/cob_id.hpp"
#include "host/drives/canopen/heartbeat.hpp"
#include "host/drives/commissioning/desk.hpp"
#include "host/drives/commissioning/jog.hpp"

namespace liana::commissioning {

// How it stands, ten times a second.
struct JogSample {
  double time_s = 0.0;  // since the first report was waited for
  DriveFeedback seen;
  std::int32_t moved_counts = 0;
  std::optional<std::int16_t> current_permille;  // 6078; nothing: the drive has none, or has not answered yet
};

struct JogOutcome {
  JogResult end = JogResult::kNone;
  bool is_off = false;  // the drive says that the motor has no power
  bool was_enabled = false;
  std::int32_t start_counts = 0;
  std::int32_t moved_counts = 0;
  std::int32_t most_torque_permille = 0;  // the largest of either sign
  std::uint16_t statusword = 0;           // the last one
  std::uint16_t emergency_code = 0;       // the first that came, else what 603F says after a fault; 0: none
};

class JogRun {
 public:
  JogRun(Desk& desk, const canopen::ExpectedDrive& drive);
  // Tells the drive to reset communication: it forgets heartbeats and process data.
  ~JogRun();
  JogRun(const JogRun&) = delete;
  JogRun& operator=(const JogRun&) = delete;

  // Boots the drive, writing what its type says. The result is kOperational, or kFailed with all that it refused.
  // Throws CommissioningInterrupted; nothing had torque then.
  const canopen::BootNode& boot();
  // After a boot that ended kOperational. An interrupt brings the motor to rest and disables it.
  JogOutcome jog(const JogRequest& request, const std::function<void(const JogSample&)>& tell);

 private:
  void on_frame(const bus::ReceivedFrame& received);
  void on_report(const bus::CanFrame& frame);
  void on_emergency(const bus::CanFrame& frame);
  void cycle(Jog& jog);
  void ask_next(bool wants_current);
  void take_answer();
  void ask_error_code(Jog& jog);
  bool is_from_drive(const bus::ReceivedFrame& received, canopen::FrameKind kind) const;

  Desk& desk_;
  canopen::ExpectedDrive drive_;
  canopen::BootNode node_;
  canopen::HeartbeatProducer heartbeat_;
  canopen::SdoClient sdo_;
  DriveFeedback seen_;
  std::uint16_t first_emergency_ = 0;
  std::int32_t max_torque_permille_ = 0;
  std::optional<std::int16_t> current_permille_;
  enum class Asked : std::uint8_t { kNothing, kCurrent, kMode };
  Asked asked_ = Asked::kNothing;    // by the transfer of `sdo_` that is under way
  bool is_operational_ = true;       // as its last heartbeat said
  std::optional<std::int8_t> mode_;  // 6061, since it was enabled
  bool has_current_ = true;          // until it says that it has no 6078
  bool has_mode_ = true;             // and 6061
};

}  // namespace liana::commissioning
