// lianad's end of the socket of devices: who may come in, what each may send, who is there. Never waits for a device.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "host/api/device/device.hpp"
#include "host/base/net/socket.hpp"

namespace liana::device {

// Where a door is, and for whom besides lianad's own user and root.
struct DeviceEndpoint {
  std::string path;
  std::optional<gid_t> group;
};

// What has happened at the door.
struct DeviceServerEvents {
  enum class What : std::uint8_t { kConnected, kGone, kRefused };
  What what = What::kConnected;
  std::string name;  // of the device; empty when it has not said hello
  std::string text;  // one sentence
};

class DeviceServer {
 public:
  static constexpr std::size_t kMaxDevices = 8;       // that have said hello
  static constexpr std::size_t kMaxUnidentified = 8;  // that have not: the oldest makes room, and each has 2 s
  static constexpr int kMaxArrivals = 16;             // in one command interval; the others wait

  // Listens; `limits` is what every device is welcomed with. Throws std::runtime_error.
  DeviceServer(const DeviceEndpoint& place, const liana_welcome& limits);
  // Nobody finds it any more.
  ~DeviceServer();
  DeviceServer(const DeviceServer&) = delete;
  DeviceServer& operator=(const DeviceServer&) = delete;

  // Readable when hear() has something to do.
  int fd() const { return epoll_.get(); }
  // Reads all that has come, within the budgets; `now_us` is arm time.
  void hear(std::int64_t now_us);
  // Sends each device what `state_for` says.
  void tell(std::int64_t now_us, const std::function<liana_state(const Device&)>& state_for);
  // A command interval is over.
  void finish_interval(double interval_s);

  // All that have said hello, by their names.
  std::vector<Device*> devices() const;
  // The one with this number, or nullptr.
  Device* find(std::uint32_t id) const;
  // What has happened since the last call.
  std::vector<DeviceServerEvents> take_events() { return std::exchange(news_, {}); }

 private:
  void let_in(std::int64_t now_us);
  void hear(Device& device, std::int64_t now_us);
  std::string admission_error(const Capability& capability) const;
  void drop_unidentified(std::int64_t now_us);
  void forget();

  DeviceEndpoint place_;
  liana_welcome limits_;
  api::UniqueFd listener_, epoll_;
  std::vector<std::unique_ptr<Device>> devices_;  // in the order in which they came
  std::uint32_t next_id_ = 1;
  int arrivals_ = 0;  // in this interval
  std::vector<DeviceServerEvents> news_;
};

}  // namespace liana::device
