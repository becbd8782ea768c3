// A link that delays between devices and lianad, or ground and arm: a program beside them, by the wall clock.
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
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/ground/packet_relay.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/clock/steady.hpp"
#include "host/base/json/json.hpp"
#include "host/base/net/connect.hpp"
#include "host/operator/station/relay.hpp"

namespace liana::cli {
namespace {

constexpr int kStep_ms = 1;
constexpr std::size_t kMaxDevices = 8;  // as lianad has them

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
    std::erase_if(relays_, [](const auto& relay) { return !relay->carry(timing::steady_us()); });
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

constexpr double kMaxOutage_s = 86400.0;

ground::Outage outage_of(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos)
    throw launcher::BadInput("--outage: '" + text + "': allowed AFTER_S,FOR_S, like 10,5: give two numbers");
  const auto part = [](const std::string& number) {
    return parse_number_in("--outage", number, 0.0, kMaxOutage_s, "s");
  };
  return {part(text.substr(0, comma)), part(text.substr(comma + 1))};
}

int relay_packets(const LinkOptions& options) {
  const haptics::Delays delays = delays_of(options);
  ground::RelayConfig config;
  config.listen = launcher::checked([&] { return api::parse_internet_address("--listen", options.listen); });
  config.to = launcher::checked([&] { return api::parse_internet_address("--to", options.to); });
  config.forward = {delays.forward_s, options.jitter, options.loss};
  config.back = {delays.back_s, options.jitter, options.loss};
  config.seed = options.seed;
  config.outage = outage_of(options.outage);
  const auto relay = launcher::checked([&] { return std::make_unique<ground::PacketRelay>(config); });
  const launcher::InterruptGuard interrupts;
  const std::string listen = relay->listen().text();
  if (options.json) {
    std::puts(Json{{"listen", listen}}.dump().c_str());
  } else {
    std::printf("packets come in at %s and go on to %s; Ctrl-C ends it\n", listen.c_str(), options.to.c_str());
  }
  std::fflush(stdout);
  while (interrupts.count() == 0) {
    relay->wait(kStep_ms);
    relay->step(timing::steady_us());
  }
  if (options.json) {
    std::puts(Json{{"sent", relay->sent()}, {"received", relay->received()}}.dump().c_str());
  } else {
    std::printf("%llu packets came in, %llu went on\n", static_cast<unsigned long long>(relay->sent()),
                static_cast<unsigned long long>(relay->received()));
  }
  return launcher::kExitOk;
}

}  // namespace

int link_command(const LinkOptions& options) {
  if (!options.to.empty()) return relay_packets(options);
  if (options.devices.empty())
    throw launcher::BadInput("link: says nowhere to go on to: allowed --devices SOCKET or --to ADDR:PORT: give one");
  launcher::InterruptGuard interrupts;
  LinkRelay desk(options);
  std::fprintf(stderr, "liana: devices come in at %s and go on to %s; Ctrl-C ends it\n", options.listen.c_str(),
               options.devices.c_str());
  while (interrupts.count() == 0) desk.step();
  return launcher::kExitOk;
}

}  // namespace liana::cli
