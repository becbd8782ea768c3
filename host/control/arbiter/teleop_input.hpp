// Who steers by hand: deadman, clutch and tracking state of the device in use; yields a tip goal per command interval
// while engaged.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "firmware_like/cable_controller.hpp"
#include "host/api/device/capability.hpp"
#include "host/api/device/sample_rate.hpp"
#include "host/control/arbiter/clutch.hpp"
#include "host/control/arbiter/hand_extrapolator.hpp"
#include "host/control/arbiter/hand_monitor.hpp"
#include "host/control/arbiter/hand_track.hpp"
#include "host/control/arbiter/jitter_buffer.hpp"

namespace liana::arbiter {

// What use_device sets.
struct DeviceUse {
  std::string name = "none";  // as it was asked for: of a kind, or of one device
  device::Kind kind = device::Kind::kNone;
  ClutchMapping mapping{};
  std::int32_t node = 0;   // handles: node that the left hand moves; 0 = none
  double speed_m_s = 0.0;  // tip speed limit while steering
  bool anywhere = false;   // handles: inside the slit, too
};

constexpr double kDeviceSilent_s = 0.1;    // so long after the last sample: has disengaged
constexpr double kClockStep_s = 0.1;       // a device's clock that goes on by more than time has is set anew: disengage
constexpr double kNodeThreshold_m = 0.01;  // a node target acts beyond this distance

// How regularly the samples of a device came, from the first of its use to the last.
struct UseRecord {
  std::string name;
  device::SampleRate rate{};
};

// One interval's wish of the operator.
struct TeleopGoal {
  Pose tip_in_base{};
  cable::NodeTarget node{};  // node = 0: none
};

class TeleopInput {
 public:
  // Another device or mapping; disengages. A deadman that is closed engages anew, from where hand and tip are then.
  void use(const DeviceUse& use);
  const DeviceUse& in_use() const { return use_; }
  bool engaged() const { return engaged_; }
  // Where hand and tip stood when the operator engaged last.
  const ClutchAnchor& anchor() const { return clutch_.anchor(); }
  // Why the operator was disengaged last, empty when by letting go (docs/reference/device-protocol.md lists them).
  const char* reason() const { return reason_; }
  // Device times of the newest and of the oldest tip sample that the last goal was made of; < 0 before the first goal
  // of a use.
  std::int64_t made_of_us() const { return made_of_us_; }
  std::int64_t made_from_us() const { return made_from_us_; }
  // Samples counted since the start.
  std::uint64_t samples() const { return samples_; }
  // Of the device in use, since it is.
  const device::SampleRate& rate() const { return rate_; }
  // The use that ended since the last call, if samples came in it.
  std::optional<UseRecord> take_ended_use() { return std::exchange(ended_use_, std::nullopt); }

  // A sample of the device in use: hand 0 steers the tip, hand 1 the node. Behind a link that is late by now more and
  // now less it waits until all are as late (even_age.hpp).
  void add(const device::Sample& sample);
  // Samples of the device in use that were not believed (Device), since the last call.
  void note_refused(std::uint64_t samples) { refused_ += samples; }
  // Ends the interval; a goal while engaged. `now` gives the anchors on engaging, `interval_s` the time since the last
  // call.
  std::optional<TeleopGoal> finish_interval(const cable::Outputs& now, double interval_s);
  // A planned move is under way: engages again where it ends, with new anchors.
  void drop_anchor() { engaged_ = false; }
  // Handles are for free space: in the slit they are let go.
  void leave_slit() { disengage("in_slit"); }
  // The device is gone: another one that takes its place begins anew, with its own clock.
  void lose_device();
  // A hold asked for by others: engages again after the deadman was open.
  void let_go() { disengage("held"); }

 private:
  void disengage(const char* reason);
  void begin_anew();
  const char* lie_of(HandMonitor& watch, device::Sample& sample) const;
  bool is_clock_set(const device::Sample& tip) const;
  void take_in(const device::Sample& tip);
  void watch_tip(const HandReading& tip, std::uint64_t came, double interval_s);
  void steer_node(const HandReading& left, const cable::Outputs& now, double interval_s);

  DeviceUse use_{};
  JitterBuffer tip_age_, node_age_;
  HandTrack tip_{}, node_{};
  HandExtrapolator tip_coast_{}, node_coast_{};
  HandMonitor tip_watch_{}, node_watch_{};
  const char* tip_lie_ = nullptr;  // what is wrong with samples of this interval
  const char* node_lie_ = nullptr;
  std::int64_t arm_us_ = 0, heard_us_ = 0;  // arm time, and when the newest tip sample came
  std::int64_t told_us_ = -1;               // by the device's clock; < 0: none came
  std::uint64_t refused_ = 0;               // samples since one was believed
  bool engaged_ = false, node_engaged_ = false;
  bool require_reengage_ = false;  // after a loss: nothing before the deadman was open once
  bool node_must_let_go_ = false;
  const char* reason_ = "";
  double silent_s_ = 0.0;
  std::uint64_t samples_ = 0, came_ = 0;  // since the start, in this interval
  device::SampleRate rate_{};
  std::optional<UseRecord> ended_use_;
  Clutch clutch_{};
  Pose hand_{};  // newest averaged pose, or where it went on to unseen
  std::int64_t newest_us_ = -1, made_of_us_ = -1;
  std::int64_t oldest_us_ = -1, made_from_us_ = -1;  // oldest of the newest interval that had samples
  bool interval_has_samples_ = false;
  Vec3 node_hand_anchor_m_{}, node_anchor_m_{};
  cable::NodeTarget node_target_{};
};

}  // namespace liana::arbiter
