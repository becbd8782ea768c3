// One device's way to lianad over a link that delays, shuffles and loses: both ends speak the protocol of devices
// (docs/reference/device-protocol.md) and need not know of it. Reads no clock.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "host/api/device/packets.hpp"
#include "host/base/net/socket.hpp"
#include "host/operator/haptics/link.hpp"
#include "host/operator/haptics/packets.hpp"

namespace liana::station {

// One direction. Samples and states may be lost, and those that were overtaken are dropped; what opens and closes a
// connection (hello, welcome, refused, bye) comes in any case, by the delay without jitter, and nothing before it.
class RelayLine {
 public:
  RelayLine(const haptics::LinkTable& table, std::uint64_t seed, std::uint64_t purpose);

  // Takes all that `from` has sent by now.
  void read(int from, std::int64_t now_us);
  // Gives `to` all that is due; a packet that it has no room for is lost.
  void write(int to, std::int64_t now_us);
  // The end that was read is gone, and all that it had sent has had its time.
  bool is_over(std::int64_t now_us) const;

 private:
  struct Parcel {
    std::uint32_t sequence = 0;
    std::shared_ptr<const std::string> packet;
  };
  static constexpr std::size_t kUnderWay = 8192;  // 2 s of 4 kHz

  void take(std::string packet, std::int64_t now_us);

  haptics::LinkTable table_;
  api::PacketReader reader_{device::kMaxPacketBytes};
  haptics::Link<Parcel, kUnderWay> hurried_;  // samples and states
  haptics::Link<Parcel> sure_;
  haptics::Newest newest_;
  std::uint32_t sequence_ = 0;
  bool is_open_ = false;  // something sure has come: a hello, or a welcome
  std::int64_t closed_us_ = -1;
};

class Relay {
 public:
  // `device` and `arm`: sockets that never block.
  Relay(api::UniqueFd device, api::UniqueFd arm, const haptics::LinkTable& forward, const haptics::LinkTable& back,
        std::uint64_t seed);

  // Carries what has come and what is due; false once an end is gone and the other one has had all of it.
  bool carry(std::int64_t now_us);

  int device() const { return device_.get(); }
  int arm() const { return arm_.get(); }

 private:
  api::UniqueFd device_, arm_;
  RelayLine forward_, back_;
};

}  // namespace liana::station
