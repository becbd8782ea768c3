// What one drive reports, what it is told, and what an arm proposes to it: in the drive's own units.
#pragma once

#include <array>
#include <cstdint>

namespace liana {

constexpr std::int32_t kMaxDrives = 32;  // compiled capacity

constexpr std::uint8_t kInOtherMode = 2;

// What one drive reported; ages count ticks since the last message (0 = in this tick).
struct DriveFeedback {
  std::uint16_t statusword = 0;      // 6041
  std::int16_t torque_permille = 0;  // 6077, of rated torque
  std::int32_t position_counts = 0;  // 6064
  std::int32_t rate_counts_s = 0;    // 606C, of torque drives
  std::uint16_t feedback_age_ticks = 0xFFFF;
  std::uint16_t heartbeat_age_ticks = 0xFFFF;
  std::uint16_t emergency_code = 0;  // last EMCY error code of this tick, 0 = none
  std::uint8_t operational = 0;      // NMT state is operational; kInOtherMode: and it shows a mode that is not its own
};
using DriveFeedbacks = std::array<DriveFeedback, kMaxDrives>;

// What goes to one drive.
struct DriveCommand {
  std::uint16_t controlword = 0;     // 6040
  std::int32_t target_counts = 0;    // 607A; cst: where the joint should be, which is not sent
  std::int16_t torque_permille = 0;  // cst: 6071, feed-forward
  std::int32_t rate_counts_s = 0;    // cst: 60B1, the rate that the drive damps against
};
using DriveCommands = std::array<DriveCommand, kMaxDrives>;

// Modes of operation (6060) in which a drive is commanded every tick; the values are CiA 402's.
enum class DriveMode : std::int8_t {
  kCyclicPosition = 8,  // csp: follows target_counts
  kCyclicTorque = 10,   // cst: follows torque_permille, and damps against rate_counts_s
};

// What an arm proposes to one drive for this tick; the gate judges it. Not rounded and perhaps not finite: that is the
// gate's business.
struct DriveProposal {
  DriveMode mode = DriveMode::kCyclicPosition;
  double target_counts = 0.0;
  double torque_permille = 0.0;  // csp: what the arm expects the drive to need; cst: the target
  double rate_counts_s = 0.0;    // cst: the rate that the drive damps against
  bool lets_go = false;          // in this tick the target may jump the way that gives in (DriveLimits::let_go_counts),
                                 // or back to where the motor stands
};
using DriveProposals = std::array<DriveProposal, kMaxDrives>;

}  // namespace liana
