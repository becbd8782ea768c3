// A link that delays between devices and lianad: a program beside it, by the wall clock.
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <vector>

#include "host/api/device/packets.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/base/net/connect.hpp"
#include "host/operator/station/relay.hpp"

namespace liana::cli {
namespace {

constexpr int kStep_ms = 1;
constexpr std::size_t kMaxDevices = 8;  // as lianad has them

std::int64_t now_us() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::microseconds>(since).count();
}

haptics::Delays delays_of(const LinkOptions& options) {
  try {
    return haptics::delays_of(options.delay);
  } catch (const std::invalid_argument& error) {
    throw launcher::BadInput(std::string("--delay: ") + error.what());
  }
}

api::UniqueFd listener_of(const LinkOptions& options) {
  const auto whole = [](const std::string& path) { return std::filesystem::weakly_canonical(path); };
  if (whole(options.listen) == whole(options.devices))
    throw launcher::BadInput("--listen: " + options.listen +
                             ": allowed is another socket than that of --devices: name a file for the devices' side");
  try {
    return api::listen_at("--listen", options.listen);
  } catch (const std::runtime_error& error) {
    throw launcher::BadInput(error.what());
  }
}

// The link of all devices that have come.
class LinkRelay {
 public:
  explicit LinkRelay(const LinkOptions& options)
      : options_(options), delays_(delays_of(options)), listener_(listener_of(options)) {}
  ~LinkRelay() { ::unlink(options_.listen.c_str()); }
  LinkRelay(const LinkRelay&) = delete;
  LinkRelay& operator=(const LinkRelay&) = delete;

  // Lets devices in and carries their packets, a millisecond.
  void step() {
    wait();
    let_in();
    std::erase_if(relays_, [](const auto& relay) { return !relay->carry(now_us()); });
  }

 private:
  void wait() const {
    std::vector<pollfd> watched{{listener_.get(), POLLIN, 0}};
    for (const auto& relay : relays_) {
      watched.push_back({relay->device(), POLLIN, 0});
      watched.push_back({relay->arm(), POLLIN, 0});
    }
    ::poll(watched.data(), watched.size(), kStep_ms);
  }

  void let_in() {
    const int fd = ::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd < 0) return;
    api::UniqueFd device(fd);
    try {
      if (relays_.size() == kMaxDevices) throw std::runtime_error("the link has 8 devices already: end one");
      api::UniqueFd arm = api::connect_to("--devices", options_.devices, 0.0);
      relays_.push_back(std::make_unique<station::Relay>(std::move(device), std::move(arm), table(delays_.forward_s),
                                                         table(delays_.back_s), options_.seed + next_++));
    } catch (const std::runtime_error& error) {
      api::send_packet(device.get(), device::bytes_of(device::refused_of(error.what())));
    }
  }

  haptics::LinkTable table(double delay_s) const { return {delay_s, options_.jitter, options_.loss}; }

  LinkOptions options_;
  haptics::Delays delays_;
  api::UniqueFd listener_;
  std::vector<std::unique_ptr<station::Relay>> relays_;
  std::uint64_t next_ = 0;
};

}  // namespace

int link_command(const LinkOptions& options) {
  launcher::InterruptGuard interrupts;
  LinkRelay desk(options);
  std::fprintf(stderr, "liana: devices come in at %s and go on to %s; Ctrl-C ends it\n", options.listen.c_str(),
               options.devices.c_str());
  while (interrupts.count() == 0) desk.step();
  return launcher::kExitOk;
}

}  // namespace liana::cli
