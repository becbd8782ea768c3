#include "host/apps/ground/server.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <stdexcept>

#include "host/base/clock/steady.hpp"
#include "host/base/json/json.hpp"

namespace liana::ground {
namespace {

constexpr int kWait_ms = 20;
constexpr double kTick_s = 0.1, kRetry_s = 1.0;
constexpr int kAtOnce = 64;  // packets or messages of one source before others have their turn

api::InternetAddress bound(api::InternetAddress address, const api::UniqueFd& fd) {
  address.port = api::port_of(fd.get());
  return address;
}

Json hello(std::uint64_t last_event) {
  Json out{{"op", "hello"},
           {"name", kClientName},
           {"role", "client"},
           {"lockstep", false},
           {"subscribe", {"state", "event"}}};
  if (last_event > 0) out["events_from"] = last_event + 1;
  return out;
}

}  // namespace

Server::Server(const ServerConfig& config)
    : config_(config),
      telemetry_(api::bind_at(api::Transport::kTcp, config.telemetry)),
      telecommand_(api::bind_at(api::Transport::kTcp, config.telecommand)),
      on_board_(config.on_board, {[this](const std::string& packet) { send(packet); },
                                  [this](const Json& what) { return request(what); }, [this] { leaves_ = true; }}) {
  config_.telemetry = bound(config.telemetry, telemetry_);
  config_.telecommand = bound(config.telecommand, telecommand_);
  datagrams_ = api::bind_at(api::Transport::kUdp, config_.telecommand);
  if (config.to) to_ = api::connect_at(api::Transport::kUdp, *config.to);
  if (config.to && to_.get() < 0) throw std::runtime_error("--udp-to: " + config.to->text() + ": cannot be reached");
}

void Server::run(const std::atomic<bool>& ended) {
  while (!ended) {
    wait();
    set_time();
    connect();
    let_in(telemetry_, readers_);
    let_in(telecommand_, commanders_);
    read_lianad();
    read_datagrams();
    read_telecommands();
    for (Peer& each : readers_) flush(each);
    std::erase_if(readers_, [](const Peer& each) { return each.is_over; });
    if (now_s_ - ticked_s_ < kTick_s) continue;
    ticked_s_ = now_s_;
    on_board_.tick();
  }
}

void Server::wait() const {
  std::vector<pollfd> watched{
      {telemetry_.get(), POLLIN, 0}, {telecommand_.get(), POLLIN, 0}, {datagrams_.get(), POLLIN, 0}};
  for (const Peer& each : readers_)
    watched.push_back({each.fd.get(), static_cast<short>(each.waiting.empty() ? POLLIN : POLLIN | POLLOUT), 0});
  for (const Peer& each : commanders_) watched.push_back({each.fd.get(), POLLIN, 0});
  if (lianad_) watched.push_back({lianad_->fd(), POLLIN, 0});
  ::poll(watched.data(), watched.size(), kWait_ms);
}

void Server::set_time() {
  now_s_ = timing::steady_s();
  const auto utc = std::chrono::system_clock::now().time_since_epoch();
  on_board_.set_time(now_s_,
                     static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(utc).count()));
}

// Where too many are there the newest is turned away: who flies keeps the connection.
void Server::let_in(const api::UniqueFd& listener, std::vector<Peer>& peers) {
  api::UniqueFd fd = api::accept_or_turn_away(listener.get(), spare_);
  if (fd.get() >= 0 && peers.size() < kMaxPeers) peers.push_back({std::move(fd)});
}

void Server::read_telecommands() {
  const bool had_some = !commanders_.empty();
  std::array<char, kMaxPacketBytes> bytes{};
  for (Peer& each : commanders_) {
    const ssize_t count = ::recv(each.fd.get(), bytes.data(), bytes.size(), 0);
    each.is_over = count == 0 || (count < 0 && errno != EAGAIN && errno != EINTR);
    if (count <= 0) continue;
    each.stream.add({bytes.data(), static_cast<std::size_t>(count)});
    while (const auto packet = each.stream.next()) on_board_.receive(*packet);
    if (!each.stream.is_lost()) continue;
    on_board_.lose_stream();
    each.is_over = true;
  }
  std::erase_if(commanders_, [](const Peer& each) { return each.is_over; });
  if (had_some && commanders_.empty()) on_board_.lose_connection();
}

void Server::read_datagrams() {
  std::array<char, kMaxPacketBytes + 1> bytes{};
  for (int i = 0; i < kAtOnce; ++i) {
    const ssize_t count = ::recv(datagrams_.get(), bytes.data(), bytes.size(), 0);
    if (count < 0) return;
    on_board_.receive({bytes.data(), static_cast<std::size_t>(count)});
  }
}

void Server::send(const std::string& packet) {
  if (to_.get() >= 0) (void)::send(to_.get(), packet.data(), packet.size(), MSG_NOSIGNAL);
  for (Peer& each : readers_) {
    each.waiting += packet;
    flush(each);
  }
}

void Server::flush(Peer& peer) {
  std::array<char, 256> ignored{};  // nothing is expected on this connection
  const ssize_t got = ::recv(peer.fd.get(), ignored.data(), ignored.size(), 0);
  peer.is_over = peer.is_over || got == 0 || peer.waiting.size() > kMaxWaitingBytes;
  if (peer.is_over || peer.waiting.empty()) return;
  const ssize_t sent = ::send(peer.fd.get(), peer.waiting.data(), peer.waiting.size(), MSG_NOSIGNAL);
  if (sent > 0) peer.waiting.erase(0, static_cast<std::size_t>(sent));
  if (sent < 0 && errno != EAGAIN && errno != EINTR) peer.is_over = true;
}

void Server::connect() {
  if (leaves_) {
    lianad_.reset();
    on_board_.controller_gone();  // nothing new where it has left lianad itself
  }
  leaves_ = false;
  if (lianad_ || now_s_ - tried_s_ < kRetry_s) return;
  tried_s_ = now_s_;
  is_welcome_ = false;
  try {
    lianad_ = api::ApiClient::connect(config_.api, 0.0);
    lianad_->send(hello(asks_for_events_ ? on_board_.last_event() : 0));
  } catch (const std::runtime_error&) {
    lianad_.reset();  // not there yet, or no longer
  }
}

void Server::read_lianad() {
  try {
    for (int i = 0; i < kAtOnce && lianad_ && !leaves_; ++i) {
      const auto message = lianad_->receive(0.0);
      if (!message) return;
      take(*message);
    }
  } catch (const JsonError& error) {
    tell(error.what());
    leaves_ = true;
  } catch (const std::runtime_error&) {
    lianad_.reset();
    on_board_.controller_gone();
  }
}

// What stands is said once: lianad is tried again every second.
void Server::tell(const std::string& problem) {
  if (!problem.empty() && problem != told_) std::fprintf(stderr, "liana: ground: lianad: %s\n", problem.c_str());
  told_ = problem;
}

// A lianad that was started anew does not have the events that are asked for.
void Server::take(const Json& message) {
  if (is_welcome_) return on_board_.take(message);
  const std::string op = message.value("op", "");
  is_welcome_ = op == "welcome";
  asks_for_events_ = is_welcome_ || !asks_for_events_;
  leaves_ = !is_welcome_;
  if (is_welcome_) on_board_.welcome(message);
  tell(is_welcome_ ? "" : message.value("message", ""));
}

bool Server::request(const Json& request) {
  if (!lianad_ || leaves_) return false;
  try {
    lianad_->send(request);
    return true;
  } catch (const std::runtime_error&) {
    leaves_ = true;
    return false;
  }
}

}  // namespace liana::ground
