// One connected device, as lianad sees it: what it can, its hands, its clock, and what is wrong with what it sends.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/api/device/clock_relation.hpp"
#include "host/api/device/packets.hpp"
#include "host/api/device/sample_rate.hpp"
#include "host/base/net/socket.hpp"

namespace liana::device {

class Device {
 public:
  static constexpr int kMaxPacketsPerInterval = 256;       // in one command interval: 4 kHz of two hands, and more
  static constexpr int kMaxRefused = 50;                   // samples in a row
  static constexpr std::int64_t kClockJump_us = 500'000;   // a device's clock goes no further ahead of the arm's
  static constexpr std::int64_t kPatience_us = 2'000'000;  // for its hello

  // Connected, but nothing said yet. `id`: 1, 2, ..., never reused.
  Device(api::UniqueFd fd, std::uint32_t id, std::int64_t now_us) : fd_(std::move(fd)), id_(id), since_us_(now_us) {}

  std::uint32_t id() const { return id_; }
  int fd() const { return fd_.get(); }
  std::int64_t since_us() const { return since_us_; }
  // Has said hello: only then it is a device.
  bool is_known() const { return known_.has_value(); }
  const Capability& capability() const { return *known_; }
  // Why it is to be forgotten; empty while it is not.
  const std::string& end() const { return end_; }
  bool was_refused() const { return was_refused_; }

  // Reads all that has come, as far as the budget of this interval goes; `now_us` is arm time. A hello is handed to the
  // door, which welcomes or refuses it.
  std::optional<Capability> hear(std::int64_t now_us);
  // The door's answer to a hello.
  void welcome(const Capability& capability, const liana_welcome& welcome);
  // Says why, and ends the connection.
  void refuse(const std::string& why);
  // The state, its header's sequence filled here. A device that does not read loses it.
  void tell(liana_state state, std::int64_t now_us);

  // Samples since the last call, in the order in which they came.
  std::vector<Sample> take_samples() { return std::exchange(samples_, {}); }
  // A command interval is over: rates are taken, and a new budget begins.
  void finish_interval(double interval_s);

  // Of each hand: the newest sample, nothing before the first, and how regularly they come.
  const std::optional<Sample>& newest(std::size_t hand) const { return newest_[hand]; }
  const SampleRate& rate(std::size_t hand) const { return rate_[hand]; }
  const ClockRelation& clock() const { return clock_; }
  // Samples that were not believed, states that it did not read in time.
  std::uint64_t refused_samples() const { return refused_samples_; }
  std::uint64_t lost_states() const { return lost_states_; }

 private:
  static constexpr std::size_t kRemembered = 64;  // states whose time of sending is known

  std::optional<Capability> take(std::string_view bytes, std::int64_t now_us);
  void take_sample(const liana_sample& packet, std::int64_t now_us);
  const char* clock_problem(const liana_sample& packet, std::int64_t now_us) const;
  void hear_echo(const liana_sample& packet, std::int64_t now_us);

  api::UniqueFd fd_;
  api::PacketReader reader_{kMaxPacketBytes};
  std::uint32_t id_;
  std::int64_t since_us_;
  std::optional<Capability> known_;
  std::int64_t hello_us_ = 0;  // by its clock
  std::string end_;
  bool was_refused_ = false;
  int packets_ = 0;         // in this interval
  int refused_in_row_ = 0;  // samples
  std::uint64_t refused_samples_ = 0, lost_states_ = 0;
  std::vector<Sample> samples_;
  std::array<std::optional<Sample>, LIANA_MAX_HANDS> newest_{};
  std::array<std::int64_t, LIANA_MAX_HANDS> heard_us_{};
  std::array<SampleRate, LIANA_MAX_HANDS> rate_{};
  ClockRelation clock_;
  std::uint32_t sequence_ = 0, echoed_ = 0;
  std::array<std::int64_t, kRemembered> sent_us_{};
};

}  // namespace liana::device
