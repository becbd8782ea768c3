// Who steers by hand: deadman, clutch and tracking state of the device in use; yields a tip goal per command interval
// while engaged.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "firmware_like/cable_controller.hpp"
#include "host/arbiter/clutch.hpp"
#include "host/arbiter/hand_track.hpp"
#include "host/arbiter/sample_rate.hpp"

namespace liana::arbiter {

enum class DeviceKind : std::uint8_t { kNone = 0, kVr = 1, kHand = 2 };

// What use_device sets.
struct DeviceUse {
  DeviceKind kind = DeviceKind::kNone;
  ClutchMapping mapping{};
  std::int32_t node = 0;   // vr: node that the left hand moves; 0 = none
  double speed_m_s = 0.0;  // tip speed limit while steering
  bool anywhere = false;   // vr: inside the slit, too
};

constexpr double kDeviceSilent_s = 0.1;    // no sample for longer: disengage
constexpr double kNodeThreshold_m = 0.01;  // a node target acts beyond this distance

// How regularly the samples of a device came, from the first of its use to the last.
struct UseRecord {
  DeviceKind kind = DeviceKind::kNone;
  SampleRate rate{};
};

// One interval's wish of the operator.
struct SteerGoal {
  Pose tip_in_base{};
  cable::NodeTarget node{};  // node = 0: none
};

class DeviceSteer {
 public:
  // Another device or mapping; disengages. A deadman that is closed engages anew, from where hand and tip are then.
  void use(const DeviceUse& use);
  const DeviceUse& in_use() const { return use_; }
  bool engaged() const { return engaged_; }
  // Why the operator was disengaged last, empty when by letting go.
  const char* reason() const { return reason_; }
  // Samples counted since the start.
  std::uint64_t samples() const { return samples_; }
  // Of the device in use, since it is.
  const SampleRate& rate() const { return rate_; }
  // The use that ended since the last call, if samples came in it.
  std::optional<UseRecord> take_ended_use() { return std::exchange(ended_use_, std::nullopt); }

  // Samples of the tip hand (vr right hand, hand controller) and of the vr left hand. Others than the device in use are
  // ignored.
  void add_tip_sample(const HandSample& sample) {
    tip_.add_sample(sample);
    rate_.add(sample.t_us);
  }
  void add_node_sample(const HandSample& sample) { node_.add_sample(sample); }

  // Ends the interval; a goal while engaged. `now` gives the anchors on engaging, `interval_s` the time since the last
  // call.
  std::optional<SteerGoal> finish_interval(const cable::Outputs& now, double interval_s);
  // A refused command: engages again at once, with new anchors.
  void drop_anchor() { engaged_ = false; }
  // Vr handles are for free space: in the slit they are let go.
  void leave_slit() { disengage("in_slit"); }
  // A hold asked for by others: engages again after the deadman was open.
  void let_go() { disengage("held"); }

 private:
  void disengage(const char* reason);
  void steer_node(const HandReading& left, const cable::Outputs& now);

  DeviceUse use_{};
  HandTrack tip_{}, node_{};
  bool engaged_ = false, node_engaged_ = false;
  bool must_let_go_ = false;  // after a loss: nothing before the deadman was open once
  const char* reason_ = "";
  double silent_s_ = 0.0;
  std::uint64_t samples_ = 0;
  SampleRate rate_{};
  std::optional<UseRecord> ended_use_;
  ClutchAnchor anchor_{};
  Pose hand_{};  // newest averaged pose
  Vec3 node_hand_anchor_m_{}, node_anchor_m_{};
  cable::NodeTarget node_target_{};
};

}  // namespace liana::arbiter
