#include "host/api/device/device_server.hpp"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "host/base/net/peer.hpp"

namespace liana::device {

namespace {

constexpr const char* kOtherUser = "lianad talks to programs of its own user, of root and of its --group";

void watch(int epoll, int fd) {
  epoll_event event{};
  event.events = EPOLLIN;
  if (::epoll_ctl(epoll, EPOLL_CTL_ADD, fd, &event) != 0)
    throw std::runtime_error(std::string("--devices: epoll: ") + std::strerror(errno));
}

std::string process_of(const Device& device) {
  const std::optional<api::Peer> peer = api::peer_of(device.fd());
  return "process " + std::to_string(peer ? peer->process : 0);
}

}  // namespace

DeviceServer::DeviceServer(const DeviceEndpoint& place, const liana_welcome& limits)
    : place_(place),
      limits_(limits),
      listener_(api::listen_at("--devices", place.path, place.group)),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)) {
  watch(epoll_.get(), listener_.get());
}

DeviceServer::~DeviceServer() { ::unlink(place_.path.c_str()); }

// Those that are there first: one that has died makes room for the one that was started in its place.
void DeviceServer::hear(std::int64_t now_us) {
  for (const auto& device : devices_) hear(*device, now_us);
  forget();
  let_in(now_us);
  drop_unidentified(now_us);
  forget();
}

void DeviceServer::let_in(std::int64_t now_us) {
  while (arrivals_ < kMaxArrivals) {
    const int fd = ::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd < 0) return;
    ++arrivals_;
    devices_.push_back(std::make_unique<Device>(api::UniqueFd(fd), next_id_++, now_us));
    if (!api::is_admitted(fd, place_.group)) {
      devices_.back()->refuse(kOtherUser);
      continue;
    }
    watch(epoll_.get(), fd);
    hear(*devices_.back(), now_us);
  }
}

void DeviceServer::hear(Device& device, std::int64_t now_us) {
  while (const std::optional<Capability> hello = device.hear(now_us)) {
    const std::string objection = admission_error(*hello);
    if (!objection.empty()) return device.refuse(objection);
    liana_welcome welcome = limits_;
    welcome.arm_time_us = now_us;
    device.welcome(*hello, welcome);
    news_.push_back({DeviceServerEvents::What::kConnected, hello->name,
                     "device " + hello->name + " (" + kind_name(hello->kind) + ") is connected"});
  }
}

std::string DeviceServer::admission_error(const Capability& capability) const {
  try {
    check(capability);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  const std::vector<Device*> known = devices();
  for (const Device* other : known) {
    if (other->capability().name == capability.name)
      return "name = '" + capability.name + "': a device of this name is connected (" + process_of(*other) +
             "): end that one, or take another name";
  }
  if (known.size() < kMaxDevices) return "";
  return std::to_string(kMaxDevices) + " devices are connected already: end one (liana device list)";
}

void DeviceServer::drop_unidentified(std::int64_t now_us) {
  std::vector<Device*> strangers;
  for (const auto& device : devices_) {
    if (!device->is_known() && device->end().empty()) strangers.push_back(device.get());
  }
  for (std::size_t i = 0; i < strangers.size(); ++i) {
    if (strangers.size() - i > kMaxUnidentified)
      strangers[i]->refuse("made room for others before it said hello");
    else if (now_us - strangers[i]->since_us() > Device::kPatience_us)
      strangers[i]->refuse("did not say hello within 2 s");
  }
}

void DeviceServer::forget() {
  for (const auto& device : devices_) {
    if (device->end().empty()) continue;
    const std::string name = device->is_known() ? device->capability().name : "";
    if (device->was_refused()) {
      news_.push_back({DeviceServerEvents::What::kRefused, name,
                       "device " + (name.empty() ? process_of(*device) : name) + " is refused: " + device->end()});
    } else if (!name.empty()) {
      news_.push_back({DeviceServerEvents::What::kGone, name, "device " + name + " is gone (" + device->end() + ")"});
    }
  }
  std::erase_if(devices_, [](const auto& device) { return !device->end().empty(); });
}

void DeviceServer::tell(std::int64_t now_us, const std::function<liana_state(const Device&)>& state_for) {
  for (Device* device : devices()) device->tell(state_for(*device), now_us);
}

void DeviceServer::finish_interval(double interval_s) {
  arrivals_ = 0;
  for (const auto& device : devices_) device->finish_interval(interval_s);
}

std::vector<Device*> DeviceServer::devices() const {
  std::vector<Device*> known;
  for (const auto& device : devices_) {
    if (device->is_known() && device->end().empty()) known.push_back(device.get());
  }
  std::sort(known.begin(), known.end(),
            [](const Device* a, const Device* b) { return a->capability().name < b->capability().name; });
  return known;
}

Device* DeviceServer::find(std::uint32_t id) const {
  const auto found = std::find_if(devices_.begin(), devices_.end(), [id](const auto& d) { return d->id() == id; });
  return found != devices_.end() && (*found)->is_known() ? found->get() : nullptr;
}

}  // namespace liana::device
