#include "host/control/server/device_manager.hpp"

#include <algorithm>
#include <utility>

#include "host/api/server/request_error.hpp"
#include "host/control/server/state_parts.hpp"

namespace liana::server {

namespace {

liana_welcome limits(double interval_s, double tip_speed_m_s) {
  auto out = device::make<liana_welcome>(LIANA_WELCOME);
  out.interval_s = interval_s;
  out.silence_s = arbiter::kDeviceSilent_s;
  out.min_rate_hz = device::kMinRate_hz;
  out.tip_speed_m_s = tip_speed_m_s;
  out.max_samples = device::Device::kMaxPacketsPerInterval;
  return out;
}

std::string names_of(const std::vector<device::Device*>& devices) {
  std::string out;
  for (const device::Device* device : devices) {
    const device::Capability& capability = device->capability();
    out += (out.empty() ? "" : ", ") + capability.name + " (" + device::kind_name(capability.kind) + ")";
  }
  return out.empty() ? "none" : out;
}

event::DeviceEvent event_of(device::DeviceServerEvents::What what) {
  using enum device::DeviceServerEvents::What;
  if (what == kConnected) return event::DeviceEvent::kConnected;
  return what == kGone ? event::DeviceEvent::kGone : event::DeviceEvent::kRefused;
}

Json summary_of(const device::Device& device, bool is_in_use) {
  const auto hz = device.rate(0).now_hz();
  const device::ClockRelation& clock = device.clock();
  const bool is_known = clock.arm_ahead_us().has_value();
  return {{"name", device.capability().name},
          {"kind", device::kind_name(device.capability().kind)},
          {"in_use", is_in_use},
          {"rate_hz", hz ? Json(*hz) : Json()},
          {"delay_up_s", is_known ? Json(clock.up_s()) : Json()},
          {"delay_down_s", is_known ? Json(clock.down_s()) : Json()},
          {"clock_known", is_known}};
}

Json hand_json(const device::Device& device, std::size_t hand) {
  const liana_hand& can = device.capability().hand[hand];
  const device::SampleRate& rate = device.rate(hand);
  Json out{{"sensed", can.sensed},
           {"actuated", can.actuated},
           {"buttons", can.buttons},
           {"low_m", {can.low_m[0], can.low_m[1], can.low_m[2]}},
           {"high_m", {can.high_m[0], can.high_m[1], can.high_m[2]}},
           {"max_force_N", can.max_force_N},
           {"max_torque_Nm", can.max_torque_Nm},
           {"samples", rate.count()},
           {"min_s", rate.least_s()},
           {"max_s", rate.most_s()},
           {"sample", nullptr}};
  if (const std::optional<device::Sample>& newest = device.newest(hand)) {
    out["sample"] = {{"t_us", newest->t_us},       {"valid", newest->valid},
                     {"deadman", newest->deadman}, {"buttons", newest->buttons},
                     {"trigger", newest->trigger}, {"measured_cp", pose_json(newest->pose)}};
  }
  return out;
}

}  // namespace

DeviceManager::DeviceManager(const device::DeviceEndpoint& place, double interval_s, double tip_speed_m_s)
    : door_(place, limits(interval_s, tip_speed_m_s)) {}

std::vector<device::Device*> DeviceManager::that_fit(const std::string& name) const {
  std::vector<device::Device*> fitting = door_.devices();
  std::erase_if(fitting, [&](const device::Device* device) {
    return device->capability().name != name && name != device::kind_name(device->capability().kind);
  });
  return fitting;
}

device::Kind DeviceManager::kind_of(const std::string& name) const {
  if (name == device::kind_name(device::Kind::kNone)) return device::Kind::kNone;
  const std::vector<device::Device*> fitting = that_fit(name);
  if (fitting.size() == 1) return fitting.front()->capability().kind;
  if (fitting.empty()) {
    throw api::RequestError("no_device", "device = " + name + ": no such device is connected; connected: " +
                                             names_of(door_.devices()) + ": start its driver, or name one of them");
  }
  throw api::RequestError("no_device",
                          "device = " + name + ": more than one fits: " + names_of(fitting) + ": give the name of one");
}

void DeviceManager::follow(const std::string& name) {
  const std::vector<device::Device*> fitting = that_fit(name);
  name_ = name;
  followed_ = fitting.size() == 1 ? fitting.front()->id() : 0;
  refused_ = followed_ != 0 ? fitting.front()->refused_samples() : 0;
}

void DeviceManager::take_samples(arbiter::TeleopInput& steer, double interval_s) {
  if (followed_ != 0 && door_.find(followed_) == nullptr) {
    steer.lose_device();
    followed_ = 0;
  }
  if (followed_ == 0 || steer.in_use().name != name_) follow(steer.in_use().name);
  for (device::Device* device : door_.devices()) {
    const std::vector<device::Sample> samples = device->take_samples();
    if (device->id() != followed_) continue;
    for (const device::Sample& sample : samples) steer.add(sample);
    steer.note_refused(device->refused_samples() - std::exchange(refused_, device->refused_samples()));
  }
  door_.finish_interval(interval_s);
}

void DeviceManager::tell(const DeviceState& state, const arbiter::TeleopInput& steer, std::int64_t now_us) {
  door_.tell(now_us, [&](const device::Device& device) {
    return state.state_for(device.id() == followed_ ? &steer : nullptr);
  });
}

std::vector<event::Event> DeviceManager::take_events() {
  std::vector<event::Event> events;
  for (const device::DeviceServerEvents& news : door_.take_events()) {
    events.push_back({.kind = event::EventKind::kDevice,
                      .number = event::number_of(event_of(news.what)),
                      .subject = news.name,
                      .text = news.text});
  }
  return events;
}

Json DeviceManager::summary() const {
  Json list = Json::array();
  for (const device::Device* device : door_.devices()) list.push_back(summary_of(*device, device->id() == followed_));
  return list;
}

Json DeviceManager::details() const {
  Json list = Json::array();
  for (const device::Device* device : door_.devices()) {
    Json entry = summary_of(*device, device->id() == followed_);
    entry["hands"] = Json::array();
    for (std::size_t hand = 0; hand < device->capability().hands; ++hand)
      entry["hands"].push_back(hand_json(*device, hand));
    entry["declared_rate_hz"] = device->capability().rate_hz;
    entry["watchdog_s"] = device->capability().watchdog_s;
    entry["refused_samples"] = device->refused_samples();
    entry["lost_states"] = device->lost_states();
    list.push_back(std::move(entry));
  }
  return {{"devices", std::move(list)}};
}

}  // namespace liana::server
