// Telemetry on its way down: counted, sent, and kept for a while to be sent again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "host/api/ground/packet.hpp"

namespace liana::ground {

class Downlink {
 public:
  using Send = std::function<void(const std::string& packet)>;

  // Keeps the newest packets, `store_bytes` in all.
  Downlink(std::size_t store_bytes, Send send) : store_bytes_(store_bytes), send_(std::move(send)) {}

  // Sends and keeps a report of this time [us since 1970]; time never goes back from packet to packet.
  void report(std::uint8_t service, std::uint8_t subtype, std::uint16_t destination, std::uint64_t time_us,
              std::string data);
  // The same for a time packet: APID 0, without a secondary header.
  void time_packet(std::uint64_t time_us, std::string data);

  // Begins to send again what was sent from `from_us` to `to_us`, both included; false while that goes on already.
  bool begin_resend(std::uint64_t from_us, std::uint64_t to_us);
  // Sends at most `packets` of it.
  void go_on_resending(std::size_t packets);
  bool is_resending() const { return left_ > 0; }

  std::uint64_t sent() const { return sent_; }
  std::uint64_t dropped() const { return dropped_; }
  std::size_t stored() const { return store_.size(); }

 private:
  struct Kept {
    std::uint64_t time_us;
    std::string packet;
  };
  void send(Telemetry telemetry);

  std::size_t store_bytes_;
  Send send_;
  std::map<std::uint16_t, std::uint16_t> counts_;                                  // by APID
  std::map<std::pair<std::uint8_t, std::uint8_t>, std::uint16_t> message_counts_;  // by service and subtype
  std::deque<Kept> store_;
  std::size_t kept_bytes_ = 0;
  std::uint64_t newest_us_ = 0, sent_ = 0, dropped_ = 0;
  std::size_t next_ = 0, left_ = 0;  // of the resend, places in the store
};

}  // namespace liana::ground
