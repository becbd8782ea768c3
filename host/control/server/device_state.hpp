// What lianad tells every device each command interval: filled here, and nowhere else
// (docs/reference/device-protocol.md).
#pragma once

#include <cstdint>
#include <optional>

#include "firmware_like/math/pose.hpp"
#include "host/api/device/packets.hpp"
#include "host/control/arbiter/teleop_input.hpp"
#include "host/control/virtual_fixtures/haptic_planes.hpp"

namespace liana::server {

// The arm, as a device is told of it.
struct ArmForDevices {
  std::uint64_t tick = 0;
  std::int64_t arm_time_us = 0;
  bool is_enabled = false;
  Pose measured_tip{}, commanded_tip{};
  std::optional<Pose> predicted_tip{};  // at the end of the command released last
  std::optional<double> clearance_m{};
  virtual_fixtures::PlaneSlots::Told planes{};  // for the device in use
};

class DeviceState {
 public:
  // `interval_s`: from state to state.
  explicit DeviceState(double interval_s) : interval_s_(interval_s) {}

  // A command was released that comes into force with `first_tick`; `made_of_us` is the device time of the newest
  // sample in it, < 0 when no device steered.
  void note_release(std::uint64_t first_tick, std::int64_t made_of_us);
  // The interval's state, once per interval.
  void look(const ArmForDevices& arm, double tick_s);
  // For a device; `steer` only where it is the one in use.
  liana_state state_for(const arbiter::TeleopInput* steer) const;

 private:
  struct Made {
    std::uint64_t first_tick = 0;
    std::int64_t of_us = -1;
  };

  double interval_s_;
  Made in_force_, next_;
  std::optional<Pose> before_;  // the tip, one interval ago
  virtual_fixtures::PlaneSlots::Told planes_{};
  liana_state common_{};
};

}  // namespace liana::server
