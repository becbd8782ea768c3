#include "hil/config/fault_kinds.hpp"

#include <algorithm>

namespace liana::bench {

namespace {

using P = FaultParameters;

std::vector<KindOfFault> of_drives() {
  using enum FaultKind;
  constexpr FaultOf kOf = FaultOf::kDrive;
  return {{"missing", kMissing, kOf, true, {}},
          {"wrong_identity", kWrongIdentity, kOf, false, {}},
          {"silent", kSilent, kOf, true, {}},
          {"fault", kFault, kOf, false, {{"code", &P::code, 1, 0xFFFF, true, false}}},
          {"sto", kSto, kOf, false, {}},
          {"late", kLate, kOf, true, {{"cycles", &P::cycles, 1, 100, true, false}}},
          {"stuck", kStuck, kOf, true, {}},
          {"noisy",
           kNoisy,
           kOf,
           true,
           {{"counts", &P::counts, 0, 1e6, false, false}, {"permille", &P::permille, 0, 1e4, false, false}}},
          {"wrong_pdo_length", kWrongPdoLength, kOf, true, {{"bytes", &P::bytes, 0, 8, true, false}}},
          {"emcy", kEmcy, kOf, false, {{"code", &P::code, 1, 0xFFFF, true, true}}},
          {"reboot", kReboot, kOf, false, {}},
          {"wrong_identity_after_reboot", kWrongIdentityAfterReboot, kOf, false, {}},
          {"encoder_jump", kEncoderJump, kOf, false, {{"counts", &P::counts, -1e6, 1e6, true, true}}},
          {"no_reports", kNoReports, kOf, true, {}},
          {"duplicate_node_id", kNodeTwice, kOf, true, {}},
          {"other_mode", kOtherMode, kOf, true, {{"mode", &P::mode, -128, 127, true, true}}},
          {"slow_reset", kSlowReset, kOf, true, {{"seconds", &P::seconds, 0.001, 60, false, false}}},
          {"slow_power", kSlowPower, kOf, true, {{"seconds", &P::seconds, 0.001, 60, false, false}}},
          {"slow_sdo", kSlowSdo, kOf, true, {{"seconds", &P::seconds, 0.001, 60, false, false}}}};
}

std::vector<KindOfFault> of_cables() {
  using enum FaultKind;
  constexpr FaultOf kOf = FaultOf::kCable;
  return {{"slack", kSlack, kOf, true, {}},
          {"cable_slip",
           kCableSlip,
           kOf,
           false,
           {{"length_m", &P::length_m, -0.1, 0.1, false, true}, {"slots", &P::slots, 1, 100000, true, false}}},
          {"cable_break", kCableBreak, kOf, false, {}},
          {"motor_saturation", kMotorSaturation, kOf, true, {{"tension_N", &P::tension_N, 0, 1e4, false, true}}},
          {"load_cell_failed", kLoadCellFailed, kOf, true, {}},
          {"load_cell_stuck", kLoadCellStuck, kOf, true, {}},
          {"load_cell_silent", kLoadCellSilent, kOf, true, {}},
          {"load_cell_off", kLoadCellOff, kOf, true, {{"tension_N", &P::tension_N, -1e4, 1e4, false, true}}}};
}

KindOfFault of_the_base() { return {"jammed", FaultKind::kJammed, FaultOf::kBase, true, {}}; }

std::vector<KindOfFault> of_the_tip() {
  using enum FaultKind;
  constexpr FaultOf kOf = FaultOf::kTip;
  return {{"camera_frozen", kCameraFrozen, kOf, true, {}},
          {"camera_late", kCameraLate, kOf, true, {{"seconds", &P::seconds, 0.001, 60, false, false}}},
          {"camera_jump", kCameraJump, kOf, true, {{"length_m", &P::length_m, -1, 1, false, true}}},
          {"camera_mirrored", kCameraMirrored, kOf, true, {}},
          {"camera_dropped", kCameraDropped, kOf, true, {}},
          {"tool_jams", kToolJams, kOf, true, {}},
          {"tool_silent", kToolSilent, kOf, true, {}}};
}

KindOfFault of_the_body() {
  using enum FaultKind;
  return {"external_force",
          kPush,
          FaultOf::kBody,
          true,
          {{"link", &P::link, 0, 128, true, false},
           {"x_N", &P::x_N, -100, 100, false, false},
           {"y_N", &P::y_N, -100, 100, false, false},
           {"z_N", &P::z_N, -100, 100, false, false},
           {"slots", &P::slots, 1, 100000, true, false}}};
}

std::vector<KindOfFault> of_the_payload() {
  using enum FaultKind;
  constexpr FaultOf kOf = FaultOf::kPayload;
  return {
      {"target_lost", kTargetLost, kOf, true, {}},
      {"sensor_failed", kSensorFailed, kOf, true, {}},
      {"sensor_stuck", kSensorStuck, kOf, true, {}},
      {"sensor_saturated", kSensorSaturated, kOf, true, {}},
      {"sensor_silent", kSensorSilent, kOf, true, {}},
      {"capture_stale", kCaptureStale, kOf, true, {}},
      {"capture_early", kCaptureEarly, kOf, true, {}},
      {"capture_twice", kCaptureTwice, kOf, true, {}},
      {"capture_lost", kCaptureLost, kOf, true, {}},
      {"capture_denied", kCaptureDenied, kOf, true, {}},
      {"depth_lies",
       kDepthLies,
       kOf,
       true,
       {{"pin", &P::pin, 1, 3, true, true}, {"depth_m", &P::depth_m, 0, 0.025, false, true}}},
      {"jam", kJam, kOf, true, {{"pin", &P::pin, 1, 3, true, true}, {"depth_m", &P::depth_m, 0, 0.025, false, true}}},
      {"latch_fails", kLatchFails, kOf, true, {}},
      {"lock_fails", kLockFails, kOf, true, {}},
      {"base_moved",
       kBaseMoved,
       kOf,
       false,
       {{"x_m", &P::x_m, -0.05, 0.05, false, false},
        {"y_m", &P::y_m, -0.05, 0.05, false, false},
        {"z_m", &P::z_m, -0.05, 0.05, false, false},
        {"slots", &P::slots, 1, 100000, true, false}}}};
}

std::vector<KindOfFault> all_kinds() {
  std::vector<KindOfFault> all = of_drives();
  for (const auto& more :
       {of_cables(), std::vector{of_the_base()}, of_the_tip(), std::vector{of_the_body()}, of_the_payload()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

const std::vector<KindOfFault>& kinds_of_faults() {
  static const std::vector<KindOfFault> all = all_kinds();
  return all;
}

const KindOfFault& row_of(FaultKind kind) {
  const auto& all = kinds_of_faults();
  return *std::find_if(all.begin(), all.end(), [kind](const KindOfFault& one) { return one.kind == kind; });
}

FaultOf fault_of(FaultKind kind) { return row_of(kind).of; }

}  // namespace liana::bench
