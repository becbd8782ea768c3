// The devices of one arm: who is connected, which one steers, and what each is told.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "host/api/device/device_server.hpp"
#include "host/base/event/event.hpp"
#include "host/base/json/json_fwd.hpp"
#include "host/control/arbiter/teleop_input.hpp"
#include "host/control/server/device_state.hpp"

namespace liana::server {

class DeviceManager {
 public:
  // Listens at `place`; `tip_speed_m_s`: the fastest that the tip follows. Throws std::runtime_error.
  DeviceManager(const device::DeviceEndpoint& place, double interval_s, double tip_speed_m_s);

  int fd() const { return door_.fd(); }
  // Reads what drivers have sent; samples wait for take_samples(). At any time.
  void hear(std::int64_t now_us) { door_.hear(now_us); }
  // Which kind the device is that `name` means: a kind (vr, hand, pointer) or the name of one device. Throws
  // RequestError with what is connected when none fits, or more than one.
  device::Kind kind_of(const std::string& name) const;
  // Once per interval: samples of the device in use go to the steering. Where it is gone another one that fits takes
  // its place, after the person has let go.
  void take_samples(arbiter::TeleopInput& steer, double interval_s);
  // Sends every device its state.
  void tell(const DeviceState& state, const arbiter::TeleopInput& steer, std::int64_t now_us);

  // The device that steers; nullptr while none does.
  const device::Device* in_use() const { return door_.find(followed_); }

  std::vector<event::Event> take_events();
  // `devices` of the state message.
  Json summary() const;
  // The answer to the request `devices`: capabilities and newest samples, too.
  Json details() const;

 private:
  std::vector<device::Device*> that_fit(const std::string& name) const;
  void follow(const std::string& name);

  device::DeviceServer door_;
  std::string name_;            // of the use that is followed
  std::uint32_t followed_ = 0;  // number of the device in use; 0: none
  std::uint64_t refused_ = 0;   // of its samples, by the last call
};

}  // namespace liana::server
