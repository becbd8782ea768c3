// The sockets of the on-board end: telemetry and telecommands over TCP and UDP, lianad over its API.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/api/server/client.hpp"
#include "host/apps/ground/on_board.hpp"
#include "host/base/net/internet_address.hpp"

namespace liana::ground {

struct ServerConfig {
  std::string api;                              // API socket of lianad; while nobody is there it is tried again
  api::InternetAddress telemetry, telecommand;  // listen: telemetry by TCP, telecommands by TCP and UDP
  std::optional<api::InternetAddress> to;       // telemetry goes here by UDP, too
  OnBoardConfig on_board{};
};

class Server {
 public:
  static constexpr std::size_t kMaxPeers = 8;               // TCP connections of each kind
  static constexpr std::size_t kMaxWaitingBytes = 1 << 20;  // of telemetry that a peer does not read; then it is closed

  // Listens. Throws std::runtime_error.
  explicit Server(const ServerConfig& config);

  // Where ground stations find it.
  const api::InternetAddress& telemetry() const { return config_.telemetry; }
  const api::InternetAddress& telecommand() const { return config_.telecommand; }
  // Serves until `ended`.
  void run(const std::atomic<bool>& ended);

 private:
  struct Peer {
    api::UniqueFd fd;
    PacketStream stream{};  // of telecommands
    std::string waiting{};  // telemetry that it has not taken yet
    bool is_over = false;
  };

  void wait() const;
  void set_time();
  void let_in(const api::UniqueFd& listener, std::vector<Peer>& peers);
  void read_telecommands();
  void read_datagrams();
  void send(const std::string& packet);
  void flush(Peer& peer);
  void connect();
  void read_lianad();
  void tell(const std::string& problem);
  void take(const Json& message);
  bool request(const Json& request);

  ServerConfig config_;
  api::UniqueFd telemetry_, telecommand_, datagrams_, to_;
  api::UniqueFd spare_;  // turns those away for whom no descriptor is left
  std::vector<Peer> readers_, commanders_;
  std::optional<api::ApiClient> lianad_;
  bool is_welcome_ = false, leaves_ = false, asks_for_events_ = true;
  std::string told_;  // what keeps it from lianad
  double now_s_ = 0.0, tried_s_ = -1e9, ticked_s_ = -1e9;
  OnBoard on_board_;
};

}  // namespace liana::ground
