// The driver's end of the socket of devices (docs/reference/device-protocol.md): one device, its samples up, the arm's
// state down. Reads no clock: every time is handed in, by the device's own clock.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "host/api/device/packets.hpp"
#include "host/base/net/socket.hpp"

namespace liana::device {

// Where lianad hears devices when it was not told: beside its API socket.
std::string devices_path(const std::string& api_path);

class Driver {
 public:
  // Connects to `path`, trying for up to `timeout_s` (lianad may still be starting), and says hello; lianad's welcome
  // comes with receive(). Throws std::runtime_error, also for a capability that would be refused.
  static Driver connect(const std::string& path, const Capability& capability, std::int64_t now_us,
                        double timeout_s = 5.0);

  // Sends samples in their order, with the echo of the newest state; never waits. False when some are lost: lianad does
  // not read quickly enough, or is gone (problem()).
  bool send(std::span<const Sample> samples);
  bool send(const Sample& sample) { return send(std::span<const Sample>(&sample, 1)); }
  // Reads all that has come; true when a newer state was among it. Never waits. Without `now_us`, for a driver to which
  // the device's clock is not known, states are not echoed, and none is fresh.
  bool receive(std::optional<std::int64_t> now_us);
  // Says that the device leaves; the same to the arm as being gone.
  void leave();

  // False once lianad has refused the device or is gone; problem() says why.
  bool is_open() const { return fd_.get() >= 0; }
  const std::string& problem() const { return problem_; }
  // For poll(): readable when receive() has something to do; -1 when not open.
  int fd() const { return fd_.get(); }

  // Nothing before it has come.
  const std::optional<liana_welcome>& welcome() const { return welcome_; }
  // The newest; nothing before the first, or when it is older than its own watchdog or that of the device: then no
  // force may be rendered.
  const liana_state* state(std::int64_t now_us) const;
  // Arm time less the device's clock [us], as the welcome tells: too small by the time that it took to come.
  std::optional<std::int64_t> arm_ahead_us() const;
  // Samples that were lost in send().
  std::uint64_t lost() const { return lost_; }

 private:
  Driver(api::UniqueFd fd, double watchdog_s) : fd_(std::move(fd)), watchdog_s_(watchdog_s) {}
  bool take(std::string_view bytes, std::optional<std::int64_t> now_us);
  void close(const std::string& why);

  api::UniqueFd fd_;
  api::PacketReader reader_{kMaxPacketBytes};
  double watchdog_s_;
  std::string problem_;
  std::optional<liana_welcome> welcome_;
  std::optional<std::int64_t> welcome_us_;
  std::optional<liana_state> state_;
  Echo echo_{};
  std::uint32_t sequence_ = 0;
  std::uint64_t lost_ = 0;
};

}  // namespace liana::device
