#include "host/operator/station/relay.hpp"

#include <cmath>
#include <utility>

#include "host/api/device/packets.hpp"

namespace liana::station {
namespace {

constexpr std::uint64_t kRelayForwardPurpose = 71;  // and 72
constexpr std::uint64_t kRelayBackPurpose = 73;     // and 74

haptics::LinkTable without_luck(const haptics::LinkTable& table) { return {table.delay_s, 0.0, 0.0}; }

// What is no packet of the protocol goes on like one that has to come: the end that gets it says what is wrong.
bool may_be_lost(const std::string& packet) {
  const device::Incoming in = device::look_at(packet);
  return in.problem.empty() && (in.header.packet == LIANA_SAMPLE || in.header.packet == LIANA_STATE);
}

}  // namespace

RelayLine::RelayLine(const haptics::LinkTable& table, std::uint64_t seed, std::uint64_t purpose)
    : table_(table), hurried_(table, seed, purpose), sure_(without_luck(table), seed, purpose + 1) {}

void RelayLine::read(int from, std::int64_t now_us) {
  std::string_view packet;
  while (closed_us_ < 0) {
    const api::SocketResult result = reader_.next(from, packet);
    if (result == api::SocketResult::kWouldBlock) return;
    if (result == api::SocketResult::kClosed) {
      closed_us_ = now_us;
    } else {
      take(std::string(packet), now_us);
    }
  }
}

void RelayLine::take(std::string packet, std::int64_t now_us) {
  const bool hurried = may_be_lost(packet);
  const Parcel parcel{sequence_++, std::make_shared<const std::string>(std::move(packet))};
  if (hurried) {
    hurried_.send(parcel, now_us);
  } else {
    sure_.send(parcel, now_us);
  }
}

void RelayLine::write(int to, std::int64_t now_us) {
  while (const auto parcel = sure_.receive(now_us)) {
    is_open_ = true;
    api::send_packet(to, *parcel->packet);
  }
  while (const auto parcel = hurried_.receive(now_us)) {
    if (is_open_ && newest_.accept(parcel->sequence)) api::send_packet(to, *parcel->packet);
  }
}

bool RelayLine::is_over(std::int64_t now_us) const {
  const std::int64_t longest_us = std::llround(1e6 * table_.delay_s * (1.0 + table_.jitter));
  return closed_us_ >= 0 && now_us > closed_us_ + longest_us;
}

Relay::Relay(api::UniqueFd device, api::UniqueFd arm, const haptics::LinkTable& forward, const haptics::LinkTable& back,
             std::uint64_t seed)
    : device_(std::move(device)),
      arm_(std::move(arm)),
      forward_(forward, seed, kRelayForwardPurpose),
      back_(back, seed, kRelayBackPurpose) {}

bool Relay::carry(std::int64_t now_us) {
  forward_.read(device_.get(), now_us);
  back_.read(arm_.get(), now_us);
  forward_.write(arm_.get(), now_us);
  back_.write(device_.get(), now_us);
  return !forward_.is_over(now_us) && !back_.is_over(now_us);
}

}  // namespace liana::station
