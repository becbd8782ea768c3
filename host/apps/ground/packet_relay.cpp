#include "host/apps/ground/packet_relay.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>

namespace liana::ground {
namespace {

constexpr std::uint64_t kForwardPurpose = 81, kBackPurpose = 82;
constexpr int kReadsAtOnce = 64;                // reads of one socket before others have their turn
constexpr std::size_t kMaxBacklog = 1u << 20u;  // octets that an end has not taken; then its connection ends

bool would_block(ssize_t count) { return count < 0 && (errno == EAGAIN || errno == EINTR || errno == ENOTCONN); }

}  // namespace

void RelayDirection::send(std::string packet, std::int64_t now_us, bool is_out) {
  ++sent_;
  if (!is_out) link_.send(std::make_shared<const std::string>(std::move(packet)), now_us);
}

std::optional<std::string> RelayDirection::receive(std::int64_t now_us) {
  const auto packet = link_.receive(now_us);
  if (!packet) return std::nullopt;
  ++received_;
  return **packet;
}

PacketRelay::PacketRelay(const RelayConfig& config)
    : config_(config),
      listener_(api::bind_at(api::Transport::kTcp, config.listen)),
      datagrams_forward_(config.forward, config.seed, kForwardPurpose),
      datagrams_back_(config.back, config.seed, kBackPurpose) {
  config_.listen.port = api::port_of(listener_.get());
  datagrams_ = api::bind_at(api::Transport::kUdp, config_.listen);
  arm_datagrams_ = api::connect_at(api::Transport::kUdp, config_.to);
}

void PacketRelay::wait(int wait_ms) const {
  std::vector<pollfd> watched{
      {listener_.get(), POLLIN, 0}, {datagrams_.get(), POLLIN, 0}, {arm_datagrams_.get(), POLLIN, 0}};
  for (const auto& each : connections_) {
    watched.push_back({each->ground.fd.get(), POLLIN, 0});
    watched.push_back({each->arm.fd.get(), POLLIN, 0});
  }
  ::poll(watched.data(), watched.size(), wait_ms);
}

void PacketRelay::step(std::int64_t now_us) {
  if (begin_us_ < 0) begin_us_ = now_us;
  let_in();
  for (const auto& each : connections_) carry(*each, now_us);
  std::erase_if(connections_, [](const auto& each) { return each->is_over; });
  carry_datagrams(now_us);
}

bool PacketRelay::is_out(std::int64_t now_us) const {
  const double since_s = 1e-6 * static_cast<double>(now_us - begin_us_) - config_.outage.after_s;
  return since_s >= 0.0 && since_s < config_.outage.for_s;
}

void PacketRelay::let_in() {
  api::UniqueFd ground = api::accept_or_turn_away(listener_.get(), spare_);
  if (ground.get() < 0 || connections_.size() >= kMaxConnections) return;
  api::UniqueFd arm = api::connect_at(api::Transport::kTcp, config_.to);
  if (arm.get() < 0) return;
  const std::uint64_t seed = config_.seed + next_++;
  connections_.push_back(std::make_unique<Connection>(Connection{{std::move(ground)},
                                                                 {std::move(arm)},
                                                                 {config_.forward, seed, kForwardPurpose},
                                                                 {config_.back, seed, kBackPurpose}}));
}

void PacketRelay::carry(Connection& connection, std::int64_t now_us) {
  const std::uint64_t sent = connection.forward.sent() + connection.back.sent();
  const std::uint64_t received = connection.forward.received() + connection.back.received();
  const bool goes_on =
      read(connection.ground, connection.forward, now_us) && read(connection.arm, connection.back, now_us) &&
      write(connection.arm, connection.forward, now_us) && write(connection.ground, connection.back, now_us);
  connection.is_over = !goes_on;
  sent_ += connection.forward.sent() + connection.back.sent() - sent;
  received_ += connection.forward.received() + connection.back.received() - received;
}

bool PacketRelay::read(End& from, RelayDirection& direction, std::int64_t now_us) const {
  std::array<char, kMaxPacketBytes> bytes{};
  for (int i = 0; i < kReadsAtOnce; ++i) {
    const ssize_t count = ::recv(from.fd.get(), bytes.data(), bytes.size(), 0);
    if (would_block(count)) return true;
    if (count <= 0) return false;
    from.stream.add({bytes.data(), static_cast<std::size_t>(count)});
    while (auto packet = from.stream.next()) direction.send(std::move(*packet), now_us, is_out(now_us));
    if (from.stream.is_lost()) return false;
  }
  return true;
}

bool PacketRelay::write(End& to, RelayDirection& direction, std::int64_t now_us) const {
  while (const auto packet = direction.receive(now_us)) to.waiting += *packet;
  if (to.waiting.empty()) return true;
  const ssize_t count = ::send(to.fd.get(), to.waiting.data(), to.waiting.size(), MSG_NOSIGNAL);
  if (count > 0) to.waiting.erase(0, static_cast<std::size_t>(count));
  return (count >= 0 || would_block(count)) && to.waiting.size() <= kMaxBacklog;
}

void PacketRelay::carry_datagrams(std::int64_t now_us) {
  std::array<char, kMaxPacketBytes + 1> bytes{};
  for (int i = 0; i < kReadsAtOnce; ++i) {
    sockaddr_storage from{};
    socklen_t size = sizeof from;
    const ssize_t count =
        ::recvfrom(datagrams_.get(), bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*>(&from), &size);
    if (count < 0) break;
    sender_.assign(reinterpret_cast<const char*>(&from), size);
    datagrams_forward_.send({bytes.data(), static_cast<std::size_t>(count)}, now_us, is_out(now_us));
    ++sent_;
  }
  for (int i = 0; i < kReadsAtOnce; ++i) {
    const ssize_t count = ::recv(arm_datagrams_.get(), bytes.data(), bytes.size(), 0);
    if (count < 0) break;
    datagrams_back_.send({bytes.data(), static_cast<std::size_t>(count)}, now_us, is_out(now_us));
    ++sent_;
  }
  while (const auto packet = datagrams_forward_.receive(now_us)) {
    (void)::send(arm_datagrams_.get(), packet->data(), packet->size(), MSG_NOSIGNAL);
    ++received_;
  }
  while (const auto packet = datagrams_back_.receive(now_us)) {
    if (!sender_.empty())
      (void)::sendto(datagrams_.get(), packet->data(), packet->size(), MSG_NOSIGNAL,
                     reinterpret_cast<const sockaddr*>(sender_.data()), static_cast<socklen_t>(sender_.size()));
    ++received_;
  }
}

}  // namespace liana::ground
