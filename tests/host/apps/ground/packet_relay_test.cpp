// A disturbed line: what comes through is by the seed, and streams stay streams of whole packets.
#include "host/apps/ground/packet_relay.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>

namespace liana::ground {
namespace {

struct Far {
  api::UniqueFd listener = api::bind_at(api::Transport::kTcp, {"127.0.0.1", 0});
  api::InternetAddress address{"127.0.0.1", api::port_of(listener.get())};
};

std::string packet(std::uint16_t count) {
  Telecommand out;
  out.primary = {0, true, true, kArmApid, 3, count, 1};
  out.service = 17;
  out.subtype = 1;
  return telecommand_bytes(out);
}

// Counts of the packets that come through when 100 are sent at once.
std::vector<int> through(const haptics::LinkTable& line, std::uint64_t seed, Outage outage = {}) {
  RelayDirection direction(line, seed, 1);
  std::vector<int> out;
  for (std::int64_t i = 0; i < 100; ++i) {
    const double now_s = 1e-3 * static_cast<double>(i);
    direction.send(packet(static_cast<std::uint16_t>(i)), 1000 * i,
                   now_s >= outage.after_s && now_s < outage.after_s + outage.for_s);
  }
  while (const auto got = direction.receive(10000000)) out.push_back(read_primary(*got)->count);
  return out;
}

TEST(RelayDirection, BringsAllInOrderWhereNothingDisturbs) {
  const std::vector<int> all = through({0.5, 0.0, 0.0}, 1);
  ASSERT_EQ(all.size(), 100u);
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
}

TEST(RelayDirection, DelaysReordersAndLosesByTheSeed) {
  const haptics::LinkTable bad{0.5, 0.5, 0.2};
  const std::vector<int> one = through(bad, 1);
  EXPECT_EQ(one, through(bad, 1));
  EXPECT_NE(one, through(bad, 2));
  EXPECT_FALSE(std::is_sorted(one.begin(), one.end()));
  EXPECT_GT(one.size(), 60u);
  EXPECT_LT(one.size(), 95u);
}

TEST(RelayDirection, LetsNothingThroughDuringAnOutage) {
  EXPECT_EQ(through({0.0, 0.0, 0.0}, 1, {0.02, 0.03}).size(), 70u);
}

TEST(PacketRelay, CarriesAStreamToTheOtherEndAfterItsDelay) {
  const Far far;
  RelayConfig config;
  config.listen = {"127.0.0.1", 0};
  config.to = far.address;
  config.forward = {1.0, 0.0, 0.0};
  PacketRelay relay(config);
  const api::UniqueFd near = api::connect_at(api::Transport::kTcp, relay.listen());
  const std::string sent = packet(1) + packet(2);
  std::string got;
  api::UniqueFd end;
  for (std::int64_t now_us = 0; now_us < 3000000 && got.size() < sent.size(); now_us += 100000) {
    relay.wait(20);
    relay.step(now_us);
    if (now_us == 500000) {
      ASSERT_EQ(::send(near.get(), sent.data(), sent.size(), MSG_NOSIGNAL), static_cast<ssize_t>(sent.size()));
    }
    if (end.get() < 0) end = api::UniqueFd(::accept4(far.listener.get(), nullptr, nullptr, SOCK_NONBLOCK));
    std::array<char, 100> bytes{};
    const ssize_t count = end.get() < 0 ? 0 : ::recv(end.get(), bytes.data(), bytes.size(), 0);
    if (count > 0) got.append(bytes.data(), static_cast<std::size_t>(count));
    EXPECT_TRUE(got.empty() || now_us >= 1500000);
  }
  EXPECT_EQ(got, sent);
  EXPECT_EQ(relay.sent(), 2u);
  EXPECT_EQ(relay.received(), 2u);
}

// Whom no descriptor is left for is turned away: the relay sleeps, and serves those who come later.
TEST(PacketRelay, SleepsWhereNoDescriptorIsLeft) {
  const Far far;
  RelayConfig config;
  config.listen = {"127.0.0.1", 0};
  config.to = far.address;
  PacketRelay relay(config);
  relay.step(0);
  rlimit before{};
  ::getrlimit(RLIMIT_NOFILE, &before);
  {
    const api::UniqueFd near = api::connect_at(api::Transport::kTcp, relay.listen());
    ASSERT_GE(near.get(), 0);
    rlimit none = before;
    none.rlim_cur = static_cast<rlim_t>(api::UniqueFd(::dup(0)).get());
    ::setrlimit(RLIMIT_NOFILE, &none);
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 1; i <= 4; ++i) {
      relay.wait(100);
      relay.step(i);
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    ::setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_GT(took.count(), 0.25) << "it looked again and again for one who waits";
    std::array<char, 8> bytes{};
    EXPECT_EQ(::recv(near.get(), bytes.data(), bytes.size(), MSG_DONTWAIT), 0) << "turned away";
  }
  const api::UniqueFd later = api::connect_at(api::Transport::kTcp, relay.listen());
  relay.wait(100);
  relay.step(10);
  EXPECT_TRUE(api::wait_readable(far.listener.get(), 1.0));
}

}  // namespace
}  // namespace liana::ground
