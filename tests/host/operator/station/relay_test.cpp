// The delayed link between devices and lianad, packet by packet (req:A12 req:A21).
#include "host/operator/station/relay.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <cstdint>
#include <optional>

#include "host/api/device/packets.hpp"

namespace liana::station {
namespace {

struct Pair {
  api::UniqueFd ours, theirs;
};

Pair pair() {
  int fd[2] = {-1, -1};
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, fd), 0);
  return {api::UniqueFd(fd[0]), api::UniqueFd(fd[1])};
}

// A device, the relay, and what stands for lianad.
class Line {
 public:
  explicit Line(const haptics::LinkTable& forward, const haptics::LinkTable& back = {})
      : relay_(std::move(device_.theirs), std::move(arm_.theirs), forward, back, 1) {}

  void hello() { send(device_.ours, device::make<liana_hello>(LIANA_HELLO)); }
  void sample(std::int64_t t_us) {
    auto packet = device::make<liana_sample>(LIANA_SAMPLE);
    packet.t_us = t_us;
    send(device_.ours, packet);
  }
  void welcome() { send(arm_.ours, device::make<liana_welcome>(LIANA_WELCOME)); }
  bool carry(std::int64_t now_us) { return relay_.carry(now_us); }
  // The next packet that lianad, or the device, has got.
  std::optional<std::string> at_arm() { return next(arm_.ours); }
  std::optional<std::string> at_device() { return next(device_.ours); }
  void device_leaves() { device_.ours = api::UniqueFd(); }
  void arm_leaves() { arm_.ours = api::UniqueFd(); }

 private:
  template <class Packet>
  static void send(const api::UniqueFd& fd, const Packet& packet) {
    EXPECT_EQ(api::send_packet(fd.get(), device::bytes_of(packet)), api::SocketResult::kDone);
  }
  static std::optional<std::string> next(const api::UniqueFd& fd) {
    std::string packet;
    if (api::receive_packet(fd.get(), packet, device::kMaxPacketBytes) != api::SocketResult::kDone) return std::nullopt;
    return packet;
  }

  Pair device_ = pair(), arm_ = pair();
  Relay relay_;
};

TEST(Relay, CarriesAHelloAndItsWelcomeLateAndUnchanged) {
  Line line({0.5, 0.2, 0.9}, {0.3, 0.2, 0.9});
  line.hello();
  line.carry(0);
  line.carry(499999);
  EXPECT_FALSE(line.at_arm());
  line.carry(500000);
  const auto hello = line.at_arm();
  ASSERT_TRUE(hello);
  EXPECT_EQ(*hello, device::bytes_of(device::make<liana_hello>(LIANA_HELLO)));
  line.welcome();
  line.carry(600000);
  line.carry(900000);
  ASSERT_TRUE(line.at_device());
}

TEST(Relay, SamplesComeInRisingOrderAfterTheHelloAndAreLostInTheirShare) {
  Line line({0.1, 0.5, 0.2});
  line.hello();
  int come = 0;
  std::int64_t newest_us = -1, first_us = -1;
  for (int k = 0; k < 4000; ++k) {
    if (k < 3000) line.sample(1000 * k);
    line.carry(1000 * k);
    while (const auto packet = line.at_arm()) {
      if (device::look_at(*packet).header.packet != LIANA_SAMPLE) continue;
      const std::int64_t t_us = device::read<liana_sample>(*packet).t_us;
      EXPECT_GT(t_us, newest_us);
      EXPECT_GE(1000 * k, t_us + 50000);
      if (first_us < 0) first_us = 1000 * k;
      newest_us = t_us;
      ++come;
    }
  }
  EXPECT_GE(first_us, 100000);
  EXPECT_GT(come, 300);
  EXPECT_LT(come, 2500);
}

TEST(Relay, EndsWhenTheDeviceHasGoneAndWhatItSentHasHadItsTime) {
  Line line({0.2, 0.0, 0.0});
  line.hello();
  EXPECT_TRUE(line.carry(0));
  line.device_leaves();
  EXPECT_TRUE(line.carry(1000));
  EXPECT_TRUE(line.carry(201000));
  EXPECT_TRUE(line.at_arm());
  EXPECT_FALSE(line.carry(201001));
}

TEST(Relay, EndsWhenLianadHasGone) {
  Line line({0.2, 0.0, 0.0});
  line.arm_leaves();
  EXPECT_TRUE(line.carry(0));
  EXPECT_FALSE(line.carry(1));
}

TEST(Relay, WhatIsNoPacketGoesOnForTheOtherEndToRefuse) {
  Pair device = pair(), arm = pair();
  Relay relay(std::move(device.theirs), std::move(arm.theirs), {0.1, 0.0, 1.0}, {}, 1);
  EXPECT_EQ(api::send_packet(device.ours.get(), "nonsense"), api::SocketResult::kDone);
  relay.carry(0);
  relay.carry(100000);
  std::string packet;
  EXPECT_EQ(api::receive_packet(arm.ours.get(), packet, device::kMaxPacketBytes), api::SocketResult::kDone);
  EXPECT_EQ(packet, "nonsense");
}

}  // namespace
}  // namespace liana::station
