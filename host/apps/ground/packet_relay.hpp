// A disturbed line between ground and arm, packet by packet: late, in another order, lost, cut off for a while. Both
// ends need not know of it. Reads no clock.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/api/ground/packet.hpp"
#include "host/base/net/internet_address.hpp"
#include "host/operator/haptics/link.hpp"

namespace liana::ground {

// From `after_s` on, counted from the first step, nothing comes through for `for_s`.
struct Outage {
  double after_s = 0.0;  // 0 to 86400
  double for_s = 0.0;    // 0 to 86400; 0: never
};

struct RelayConfig {
  api::InternetAddress listen, to;  // TCP and UDP
  haptics::LinkTable forward{}, back{};
  std::uint64_t seed = 1;
  Outage outage{};
};

// One direction of one connection.
class RelayDirection {
 public:
  RelayDirection(const haptics::LinkTable& table, std::uint64_t seed, std::uint64_t purpose)
      : link_(table, seed, purpose) {}

  // A packet that has been sent, or is lost in the outage.
  void send(std::string packet, std::int64_t now_us, bool is_out);
  // The next that has come by now.
  std::optional<std::string> receive(std::int64_t now_us);
  std::uint64_t sent() const { return sent_; }
  std::uint64_t received() const { return received_; }

 private:
  static constexpr std::size_t kUnderWay = 8192;
  haptics::Link<std::shared_ptr<const std::string>, kUnderWay> link_;
  std::uint64_t sent_ = 0, received_ = 0;
};

class PacketRelay {
 public:
  static constexpr std::size_t kMaxConnections = 8;

  // Listens. Throws std::runtime_error.
  explicit PacketRelay(const RelayConfig& config);

  // Where it listens: the port, where a free one was wanted.
  const api::InternetAddress& listen() const { return config_.listen; }
  // Waits at most `wait_ms` for something to carry.
  void wait(int wait_ms) const;
  // Carries what has come and what is due.
  void step(std::int64_t now_us);
  // Packets of both directions: taken in, and handed on.
  std::uint64_t sent() const { return sent_; }
  std::uint64_t received() const { return received_; }

 private:
  struct End {
    api::UniqueFd fd;
    PacketStream stream{};
    std::string waiting{};  // octets that the socket has not taken yet
  };
  struct Connection {
    End ground, arm;
    RelayDirection forward, back;
    bool is_over = false;
  };

  void let_in();
  void carry(Connection& connection, std::int64_t now_us);
  bool read(End& from, RelayDirection& direction, std::int64_t now_us) const;
  bool write(End& to, RelayDirection& direction, std::int64_t now_us) const;
  void carry_datagrams(std::int64_t now_us);
  bool is_out(std::int64_t now_us) const;

  RelayConfig config_;
  api::UniqueFd listener_, datagrams_, arm_datagrams_;
  api::UniqueFd spare_;  // turns those away for whom no descriptor is left
  RelayDirection datagrams_forward_, datagrams_back_;
  std::vector<std::unique_ptr<Connection>> connections_;
  std::string sender_{};  // address of the newest datagram, to which answers go
  std::uint64_t next_ = 1, sent_ = 0, received_ = 0;
  std::int64_t begin_us_ = -1;
};

}  // namespace liana::ground
