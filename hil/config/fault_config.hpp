// The fault list of the bench: which drive, what, from when, how long (docs/how-to/run-hil.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace liana::bench {

enum class FaultKind {
  kMissing,
  kWrongIdentity,
  kSilent,
  kFault,
  kSto,
  kSlack,
  kLate,
  kStuck,
  kNoisy,
  kWrongPdoLength,
  kEmcy,
  kReboot,
  kWrongIdentityAfterReboot,
  kEncoderJump,
  kCableSlip,
  kCableBreak,
  kMotorSaturation,
  kJammed,
  kLoadCellFailed,
  kLoadCellStuck,
  kLoadCellSilent,
  kLoadCellOff,
  kNoReports,
  kNodeTwice,
  kOtherMode,
  kSlowReset,
  kSlowPower,
  kSlowSdo,
  kCameraFrozen,
  kCameraLate,
  kCameraJump,
  kCameraMirrored,
  kCameraDropped,
  kToolJams,
  kToolSilent,
  kPush,
  kTargetLost,
  kSensorFailed,
  kSensorStuck,
  kSensorSaturated,
  kSensorSilent,
  kCaptureStale,
  kCaptureEarly,
  kCaptureTwice,
  kCaptureLost,
  kCaptureDenied,
  kDepthLies,
  kJam,
  kLatchFails,
  kLockFails,
  kBaseMoved
};

// What a fault happens to. Of drives, cables and bases it names drives, of the others none.
enum class FaultOf {
  kDrive,
  kCable,    // what a drive of a cable arm moves
  kBase,     // what a drive of a base moves
  kTip,      // camera and tool
  kBody,     // of a cable arm
  kPayload,  // its target, wrist sensor, adapter and base: of an arm that installs a payload
};
FaultOf fault_of(FaultKind kind);

// What a kind can be told; the kinds that have no use for a value ignore it.
struct FaultParameters {
  double cycles = 1.0;    // SYNC periods
  double counts = 0.0;    // encoder
  double permille = 0.0;  // of rated torque
  double bytes = 7.0;
  double mode = 1;       // of operation (6061)
  double code = 0x2310;  // emergency code; the default is continuous over-current
  double length_m = 0.0;
  double slots = 1.0;      // SYNC periods that it takes
  double tension_N = 0.0;  // at the drum
  double seconds = 0.4;
  double link = 0.0;  // 1 at the base; 0: the tip
  double x_N = 0.0, y_N = 0.0, z_N = 0.0;
  double pin = 1.0;  // of the adapter, from 1
  double depth_m = 0.0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
};

// All that is named has to hold for `for_slots` slots in a row.
struct FaultCondition {
  std::optional<std::size_t> theta;  // 0-based; its true angle has to lie in [above, below]
  double above_rad = -1e9;
  double below_rad = 1e9;
  bool enabled = false;                   // every drive in Operation enabled
  bool moving = false;                    // some true angle turns faster than kMoving_rad_s
  std::optional<double> depth_above_m;    // the true tip is further than this past the mouth of the slit, the true pins
                                          // of a payload on the arm past the adapter's face
  std::optional<double> depth_below_m;    // the same, not so far
  std::optional<double> contact_above_N;  // the payload gives the adapter more than this
  bool captured = false;                  // the adapter truly has the payload
  std::optional<double> carried_above;    // the arm that carries is told to have gone more than this share of its way
  std::optional<std::uint32_t> after_first_slots;  // the first fault of the list began so many slots ago
  std::uint32_t for_slots = 1;
};

struct FaultConfig {
  std::vector<std::size_t> drives;  // 0-based, at least one; none where kinds have none
  FaultKind kind = FaultKind::kFault;
  std::string name;                      // of the kind
  std::optional<std::uint32_t> at_slot;  // without it `when` decides
  FaultCondition when;
  std::optional<std::uint32_t> for_slots;  // then it ends; without it, it stays
  FaultParameters parameters;
};

// Throws std::runtime_error naming the first fault of such a kind; `why` says what the robot at hand has instead.
void refuse_faults(const std::vector<FaultConfig>& faults, const std::vector<FaultOf>& of, const std::string& why);

// The same for faults of a payload, or that wait for one; `why` goes on from "of a payload".
void refuse_payload_faults(const std::vector<FaultConfig>& faults, const std::string& why);

// Reads a JSON list of faults; throws std::runtime_error naming file, field, value and what is allowed.
std::vector<FaultConfig> load_faults(const std::string& path, std::size_t drive_count, std::size_t theta_count);

// The same of a text whose faults all begin at `slot`: they have neither at_slot nor when.
std::vector<FaultConfig> faults_at(std::uint32_t slot, const std::string& text, std::size_t drive_count);

}  // namespace liana::bench
