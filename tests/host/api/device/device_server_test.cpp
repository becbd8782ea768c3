// lianad's door for devices: who comes in, what each may send, and what happens to those that send more.
#include "host/api/device/device_server.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <limits>

#include "host/base/net/connect.hpp"
#include "tests/host/api/device/pair.hpp"
#include "tests/message.hpp"

namespace liana::device {
namespace {

class AtTheDoor : public testing::Test {
 protected:
  AtTheDoor()
      : place_(place_of_test(testing::UnitTest::GetInstance()->current_test_info()->name())),
        door_(place_, limits_of_test()) {}

  Driver come(const std::string& name) {
    Driver driver = Driver::connect(place_.path, hand_controller(name), 0, 0.0);
    door_.hear(now_us_);
    driver.receive(0);
    return driver;
  }
  // What a raw packet as the first, or after a hello, is refused with.
  std::string answer_to(std::string_view bytes, bool after_hello) {
    const api::UniqueFd fd = api::connect_to("--devices", place_.path, 0.0);
    if (after_hello) api::send_packet(fd.get(), bytes_of(hello_of(hand_controller("raw"), 0)));
    api::send_packet(fd.get(), bytes);
    door_.hear(now_us_);
    std::string packet;
    while (api::receive_packet(fd.get(), packet) == api::SocketResult::kDone) {
      if (look_at(packet).header.packet == LIANA_REFUSED)
        return text_of(read<liana_refused>(packet).text, sizeof liana_refused::text);
    }
    return "";
  }
  std::string news() {
    std::string all;
    for (const DeviceServerEvents& item : door_.take_events()) all += item.text + "; ";
    return all;
  }

  DeviceEndpoint place_;
  DeviceServer door_;
  std::int64_t now_us_ = 1'000'000;
};

TEST_F(AtTheDoor, WhoSaysHelloIsWelcomedAndListedByItsName) {
  const Driver second = come("omega"), first = come("falcon");
  ASSERT_TRUE(first.welcome());
  EXPECT_EQ(first.welcome()->arm_time_us, now_us_);
  EXPECT_EQ(first.welcome()->interval_s, 0.02);
  ASSERT_EQ(door_.devices().size(), 2u);
  EXPECT_EQ(door_.devices()[0]->capability().name, "falcon");
  EXPECT_EQ(door_.devices()[0]->capability().hand[0].max_force_N, 12.0);
  EXPECT_TRUE(names(news(), {"device omega", "device falcon"}));
}

TEST_F(AtTheDoor, SamplesComeAsTheyWereSent) {
  Driver driver = come("omega");
  const Sample sent{.t_us = 5,
                    .deadman = true,
                    .buttons = 2,
                    .trigger = 0.25,
                    .pose = {{0.01, 0.02, 0.03}},
                    .twist = {{0.1, 0.2, 0.3}, {1.0, 2.0, 3.0}}};
  EXPECT_TRUE(driver.send(sent));
  door_.hear(now_us_);
  const std::vector<Sample> got = door_.devices()[0]->take_samples();
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0].t_us, 5);
  EXPECT_TRUE(got[0].deadman && got[0].valid);
  EXPECT_EQ(got[0].buttons, 2u);
  EXPECT_EQ(got[0].trigger, 0.25);
  EXPECT_EQ(got[0].pose.position_m, sent.pose.position_m);
  EXPECT_EQ(got[0].twist.angular_rad_s, sent.twist.angular_rad_s);
  EXPECT_TRUE(door_.devices()[0]->take_samples().empty()) << "handed over once";
}

TEST_F(AtTheDoor, TheSocketIsForItsUserAndGoneAtTheEnd) {
  struct stat found {};
  ASSERT_EQ(::stat(place_.path.c_str(), &found), 0);
  EXPECT_EQ(found.st_mode & 0777u, 0600u);
  const DeviceEndpoint place = place_of_test("ends");
  { const DeviceServer ends(place, limits_of_test()); }
  EXPECT_NE(::stat(place.path.c_str(), &found), 0);
}

TEST_F(AtTheDoor, ADriverThatDiesIsGoneAndItsNameIsFree) {
  { const Driver driver = come("omega"); }
  door_.hear(now_us_);
  EXPECT_TRUE(door_.devices().empty());
  EXPECT_TRUE(names(news(), {"device omega", "gone", "closed"}));
  EXPECT_TRUE(come("omega").welcome());
  Driver polite = come("falcon");
  polite.leave();
  door_.hear(now_us_);
  EXPECT_TRUE(names(news(), {"device falcon", "gone", "bye"}));
}

TEST_F(AtTheDoor, TwoOfOneNameAndANinthAreRefusedWithAReason) {
  std::vector<Driver> drivers;
  drivers.push_back(come("omega"));
  EXPECT_TRUE(names(come("omega").problem(), {"name", "connected"}));
  for (int i = 1; i < 8; ++i) drivers.push_back(come("d" + std::to_string(i)));
  EXPECT_TRUE(names(come("late").problem(), {"8 devices"}));
  EXPECT_EQ(door_.devices().size(), 8u);
}

// Each row: what is sent, and what the refusal names.
TEST_F(AtTheDoor, WhatIsNoPacketEndsTheConnectionAndSaysWhy) {
  auto hello = hello_of(hand_controller("raw"), 0);
  hello.header.magic = 7;
  EXPECT_TRUE(names(answer_to(bytes_of(hello), false), {"header.magic", "7"}));
  hello = hello_of(hand_controller("raw"), 0);
  hello.header.version = 9;
  EXPECT_TRUE(names(answer_to(bytes_of(hello), false), {"header.version", "9", "1"}));
  hello = hello_of(hand_controller("raw"), 0);
  EXPECT_TRUE(names(answer_to(bytes_of(hello).substr(0, 100), false), {"header.bytes", "240"}));
  hello.header.bytes = 12;
  EXPECT_TRUE(names(answer_to(bytes_of(hello), false), {"header.bytes", "12", "240"}));
  EXPECT_TRUE(names(answer_to("{\"op\":\"hello\"}", false), {"14 bytes"}));
  const auto sample = packet_of(Sample{}, 1, {});
  EXPECT_TRUE(names(answer_to(bytes_of(sample), false), {"first", "hello"}));
  EXPECT_TRUE(names(answer_to(bytes_of(hello_of(hand_controller("raw"), 0)), true), {"first", "hello"}));
  EXPECT_TRUE(names(answer_to(bytes_of(state_of_test()), true), {"header.packet", "6"}));
  EXPECT_TRUE(door_.devices().empty());
}

TEST_F(AtTheDoor, AHelloOutOfRangeIsRefusedByItsField) {
  const auto refusal = [this](auto change) {
    Capability capability = hand_controller("raw");
    change(capability);
    return answer_to(bytes_of(hello_of(capability, 0)), false);
  };
  EXPECT_TRUE(names(refusal([](Capability& c) { c.name = "a b"; }), {"name", "a?b"}));
  EXPECT_TRUE(names(refusal([](Capability& c) { c.name = "vr"; }), {"name", "vr"}));
  EXPECT_TRUE(names(refusal([](Capability& c) { c.kind = Kind::kNone; }), {"kind", "0"}));
  EXPECT_TRUE(names(refusal([](Capability& c) { c.hands = 3; }), {"hands", "3", "1", "2"}));
  EXPECT_TRUE(names(refusal([](Capability& c) { c.rate_hz = 0.0; }), {"rate_hz", "0", "1", "4000"}));
  EXPECT_TRUE(names(refusal([](Capability& c) { c.watchdog_s = std::nan(""); }), {"watchdog_s", "nan"}));
  EXPECT_TRUE(names(refusal([](Capability& c) { c.hand[0].low_m[1] = 0.2; }), {"hand[0].high_m", "0.1", "0.2", "10"}));
  EXPECT_TRUE(names(refusal([](Capability& c) { c.hand[0].sensed = 128; }), {"hand[0].sensed", "128"}));
}

TEST_F(AtTheDoor, NumbersThatAreNoneAreRefusedAndCounted) {
  Driver driver = come("omega");
  const double denormal = std::numeric_limits<double>::denorm_min();
  for (const double bad : {std::nan(""), HUGE_VAL, denormal, 11.0}) {
    Sample sample{.t_us = 10};
    sample.pose.position_m[1] = bad;
    driver.send(sample);
  }
  driver.send({.t_us = 11, .hand = 1});
  driver.send({.t_us = 12, .trigger = 1.5});
  driver.send({.t_us = 13, .pose = {{}, {1.0, 1.0, 0.0, 0.0}}});
  driver.send({.t_us = -1});
  driver.send({.t_us = 14});
  door_.hear(now_us_);
  EXPECT_EQ(door_.devices()[0]->refused_samples(), 8u);
  EXPECT_EQ(door_.devices()[0]->take_samples().size(), 1u);
}

TEST_F(AtTheDoor, AClockThatGoesBackOrAheadIsNotBelievedAndHasToSayHelloAgain) {
  Driver driver = come("omega");
  driver.send({.t_us = 1'000'000});
  driver.send({.t_us = 1'000'000});
  driver.send({.t_us = 900'000});
  driver.send({.t_us = 1'600'000});
  door_.hear(now_us_);
  EXPECT_EQ(door_.devices()[0]->refused_samples(), 3u);
  now_us_ += 200'000;
  driver.send({.t_us = 1'600'000});  // so much time has passed that this may be
  door_.hear(now_us_);
  EXPECT_EQ(door_.devices()[0]->refused_samples(), 3u);
  for (int i = 0; i < Device::kMaxRefused; ++i) driver.send({.t_us = 100});
  door_.hear(now_us_);
  driver.receive(0);
  EXPECT_TRUE(names(driver.problem(), {"50 samples", "t_us"}));
  EXPECT_TRUE(names(news(), {"device omega", "refused", "50 samples"}));
}

TEST_F(AtTheDoor, AFloodClosesThatDeviceAndNoOther) {
  Driver calm = come("calm"), flood = come("flood");
  for (std::int64_t i = 1; i <= 300 && flood.is_open(); ++i) {
    flood.send({.t_us = i});
    if (i % 50 == 0) door_.hear(now_us_);
  }
  flood.receive(0);
  EXPECT_TRUE(names(flood.problem(), {"256 packets"}));
  ASSERT_EQ(door_.devices().size(), 1u);
  for (int interval = 0; interval < 20; ++interval) {
    for (std::int64_t i = 0; i < 80; ++i) calm.send({.t_us = 80 * interval + i + 1});
    door_.hear(now_us_);
    door_.finish_interval(0.02);
  }
  EXPECT_EQ(door_.devices()[0]->take_samples().size(), 1600u) << "4 kHz are no flood";
}

TEST_F(AtTheDoor, WhoSaysNothingTakesNoPlaceAndIsSentAwayInTime) {
  std::vector<api::UniqueFd> silent;
  for (int i = 0; i < 10; ++i) silent.push_back(api::connect_to("--devices", place_.path, 0.0));
  door_.hear(now_us_);
  EXPECT_TRUE(come("omega").welcome()) << "strangers are no devices";
  now_us_ += Device::kPatience_us + 1;
  door_.hear(now_us_);
  for (const api::UniqueFd& fd : silent) {
    std::string packet;
    EXPECT_EQ(api::receive_packet(fd.get(), packet), api::SocketResult::kDone);
    EXPECT_EQ(look_at(packet).header.packet, LIANA_REFUSED);
  }
}

TEST_F(AtTheDoor, ADriverThatDoesNotReadLosesStatesAndHoldsNobodyUp) {
  const Driver driver = come("omega");
  for (int i = 0; i < 1000; ++i) door_.tell(now_us_, [](const Device&) { return state_of_test(); });
  EXPECT_GT(door_.devices()[0]->lost_states(), 0u);
}

}  // namespace
}  // namespace liana::device
