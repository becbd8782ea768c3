// What is wrong with the drives of a base that feeds: an encoder that jumped, and a force that neither the arm's motion
// nor its load explains. Nothing stretches between such a drive and what it moves, so that its encoder and its torque
// say by themselves what length and tension of a cable say together.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/cable/arm/tension_monitor.hpp"
#include "firmware_like/drive/drive_io.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"

namespace liana::cable {

constexpr double kFeedJumpWindow_m = 2e-4;       // besides, for noise of the encoder
constexpr double kFeedFriction = 0.05;           // of the drive's rated torque: guide, rack and belt take no more
constexpr double kFeedTip_N = 3.0;               // a push at the tip is explained up to this, as for cables
constexpr double kFeedWeight = 0.1;              // share of the weight that table and truth may differ by
constexpr std::uint16_t kFeedDebounceTicks = 5;  // a few wrong torque samples are no obstacle

// What one drive of a base has read in this tick.
struct FeedReading {
  double force_N = 0.0;  // positive where it pulls its slide back, or its roll
  bool jumped = false;   // from the reading before to this one, by more than the axis can move
};
using FeedReadings = std::array<FeedReading, 2>;  // slide, roll

// Reads both drives, `before_m` being where they stood in the tick before; `heard`: they had been read then.
FeedReadings read_feed(const RobotParams& table, const DriveFeedbacks& drives, const CableVector& zero_payout_m,
                       const CableVector& before_m, bool heard) noexcept;

// Torque [N m] about the axis of `drive` (0 slide, 1 roll) that holds the carriage, beside what holds the arm.
double carriage_load_Nm(const RobotParams& table, std::int32_t drive) noexcept;

// Force [N] of `drive` under which its axis stands, the arm needing `load_Nm` about it.
inline double feed_force_N(const RobotParams& table, std::int32_t drive, double load_Nm) noexcept {
  return -(load_Nm + carriage_load_Nm(table, drive)) / feed_m_rad(table.segment[0])[static_cast<std::size_t>(drive)];
}

// Most [N] by which the drive's force may differ from that: friction, a push at the tip, weight that nobody declared.
double feed_unexplained_N(const RobotParams& table, std::int32_t drive) noexcept;

// Latches an encoder that jumped, with power a force over the hard limit, and once the arm is prepared one that
// `load_Nm` does not explain; the detail of that is torque about the axis in 0.01 N m. It is counted in what counts
// slack ticks of a cable.
void watch_feed(const RobotParams& table, WatchScope scope, const FeedReading& now, double load_Nm, std::int32_t drive,
                TensionMonitorState& state, Watch& out) noexcept;

}  // namespace liana::cable
