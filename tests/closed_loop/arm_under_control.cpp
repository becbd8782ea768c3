#include "arm_under_control.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "firmware_like/cable/arm/payout.hpp"
#include "firmware_like/cable/motion/servo_ik.hpp"
#include "firmware_like/command/release.hpp"
#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/trig.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {

using namespace cable;

namespace {

constexpr double kBootLimit_s = 10.0;
// Statuswords (6041) that a drive sends.
constexpr std::uint16_t kStatusDisabled = 0x0250;
constexpr std::uint16_t kStatusReady = 0x0231;
constexpr std::uint16_t kStatusSwitchedOn = 0x0233;
constexpr std::uint16_t kStatusEnabled = 0x1237;

std::uint16_t status_after(std::uint16_t controlword) {
  if ((controlword & 0x000F) == kEnableOperation) return kStatusEnabled;
  if ((controlword & 0x000F) == kSwitchOn) return kStatusSwitchedOn;
  return (controlword & 0x0007) == kShutdown ? kStatusReady : kStatusDisabled;
}

}  // namespace

ArmUnderControl::ArmUnderControl(const PlantSetup& setup, const std::string& told)
    : ArmUnderControl(setup, robot_table(told.empty() ? setup.physics : told)) {}

ArmUnderControl::ArmUnderControl(const PlantSetup& setup, const cable::RobotParams& table)
    : table_(table), plant_(setup), controller_(table_) {
  const cable::CableLayout layout = cable_layout(table_);
  for (std::size_t c = 0; c < as_index(table_.cable_count()); ++c) {
    zero_payout_m_[c] = layout.zero_length_m[c] + table_.lead_m;
    in_.drive[c].statusword = kStatusDisabled;
  }
  if (setup.geometry_share == 0.0) return;
  cable::RobotParams built = table_;
  for (std::size_t j = 0; j < as_index(table_.segment_count); ++j)
    built.segment[j].module_length_m = plant_.module_length_m(j);
  const cable::CableLayout there = cable_layout(built);
  for (std::size_t c = 0; c < as_index(table_.cable_count()); ++c)
    jig_m_[c] = there.zero_length_m[c] - layout.zero_length_m[c];
}

cable::CableVector ArmUnderControl::targets_m() const {
  cable::CableVector target{};
  for (std::size_t c = 0; c < as_index(table_.cable_count()); ++c) {
    target[c] = payout_at_counts(table_.drive[c], zero_payout_m_[c], out_.drive[c].target_counts) + jig_m_[c];
  }
  return target;
}

void ArmUnderControl::answer(std::size_t drive, std::uint16_t controlword) {
  DriveFeedback& feedback = in_.drive[drive];
  feedback.feedback_age_ticks = 0;
  feedback.heartbeat_age_ticks = 0;
  feedback.operational = 1;
  feedback.statusword = status_after(controlword);
}

void ArmUnderControl::read_drives() {
  const cable::CableVector payout = plant_.measured_payout_m();
  const cable::CableVector tension = plant_.measured_tension_N();
  for (std::size_t c = 0; c < as_index(table_.cable_count()); ++c) {
    const cable::DriveParams& drive = table_.drive[c];
    if (gone_[c]) {
      if (in_.drive[c].feedback_age_ticks < 0xFFFF) ++in_.drive[c].feedback_age_ticks;
      continue;
    }
    answer(c, out_.drive[c].controlword);
    in_.drive[c].position_counts = to_counts(counts_at_payout(drive, zero_payout_m_[c], payout[c] - jig_m_[c])).value;
    in_.drive[c].torque_permille = narrow<std::int16_t>(to_counts(tension[c] / drive.newtons_per_permille).value);
  }
}

void ArmUnderControl::lose_drive(std::size_t drive) {
  gone_[drive] = true;
  plant_.stand_still(drive);
}

void ArmUnderControl::step() {
  // SYNC: drives act on what the last tick sent, and sample; the new targets wait for the next SYNC.
  read_drives();
  const cable::CableVector acted_on_m = targets_m();
  const bool powered =
      std::ranges::any_of(in_.drive, [](const DriveFeedback& drive) { return drive.statusword == kStatusEnabled; });
  ++in_.tick;
  out_ = controller_.tick(in_);
  in_.request = Request::kNone;
  in_.telecommand = cable::Telecommand{};
  plant_.advance(table_.tick_s, acted_on_m, powered);
}

void ArmUnderControl::wait(double seconds) {
  for (std::int32_t i = 0; i < to_counts(seconds / table_.tick_s).value; ++i) step();
}

void ArmUnderControl::boot() {
  wait(0.5);
  in_.request = Request::kEnable;
  for (double t = 0.0; t < kBootLimit_s && out_.state != OperatingState::kEnabled; t += table_.tick_s) step();
  if (out_.state == OperatingState::kEnabled) return;
  const auto fault =
      static_cast<std::int32_t>(out_.faults.count > 0 ? out_.faults.fault[0].number : FaultNumber::kNone);
  throw std::runtime_error("closed loop: not enabled within 10 s; first fault " + std::to_string(fault));
}

void ArmUnderControl::disable() {
  in_.request = Request::kDisable;
  for (double t = 0.0; t < kBootLimit_s && (t == 0.0 || out_.state != OperatingState::kDisabled); t += table_.tick_s)
    step();
}

void ArmUnderControl::interval(const cable::Telecommand& telecommand, const Observer& observer) {
  in_.telecommand = telecommand;
  for (std::int32_t i = 0; i < table_.interval_ticks; ++i) {
    step();
    if (observer) observer(*this);
  }
}

void ArmUnderControl::follow(double seconds, const Path& path, const Observer& observer) {
  const std::int32_t intervals = to_counts(seconds / (table_.tick_s * table_.interval_ticks)).value;
  for (std::int32_t k = 1; k <= intervals; ++k) {
    const std::uint64_t now = in_.tick + 1;
    interval(Release::make(++sequence_, now, now + narrow<std::uint64_t>(table_.interval_ticks), 1,
                           path(static_cast<double>(k) / static_cast<double>(intervals))),
             observer);
  }
}

void ArmUnderControl::move_joints(const cable::ThetaVector& goal_rad, double seconds, const Observer& observer) {
  const cable::ThetaVector from = out_.theta_command_rad;
  follow(
      seconds,
      [&](double share) {
        cable::Setpoint setpoint;
        setpoint.kind = CommandKind::kJoint;
        setpoint.payload = payload_;
        const double done = minimum_jerk(share);
        for (std::size_t i = 0; i < from.size(); ++i) setpoint.joint_rad[i] = from[i] + done * (goal_rad[i] - from[i]);
        return setpoint;
      },
      observer);
}

void ArmUnderControl::hold(double seconds, const Observer& observer) {
  cable::Setpoint setpoint;
  setpoint.kind = CommandKind::kJoint;
  setpoint.joint_rad = out_.theta_command_rad;
  setpoint.payload = payload_;
  follow(
      seconds, [&](double) { return setpoint; }, observer);
}

TruthError ArmUnderControl::error_against(const cable::ThetaVector& theta_rad) const {
  const Pose wanted = forward_kinematics(table_, theta_rad).tip_in_base;
  const std::array<double, 6> error = pose_error(wanted, plant_.tip_in_base());
  return {largest_difference_deg(plant_.theta_rad(), theta_rad), 1000.0 * norm({error[0], error[1], error[2]}),
          norm({error[3], error[4], error[5]}) / kDegree};
}

}  // namespace liana::closed_loop
