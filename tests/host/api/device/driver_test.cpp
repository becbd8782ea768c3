// A driver's end: clocks, delays measured by the echo, and the watchdog on what comes down.
#include "host/api/device/driver.hpp"

#include <gtest/gtest.h>

#include "tests/host/api/device/pair.hpp"

namespace liana::device {
namespace {

class AtADevice : public testing::Test {
 protected:
  AtADevice()
      : place_(place_of_test(testing::UnitTest::GetInstance()->current_test_info()->name())),
        door_(place_, limits_of_test()),
        driver_(Driver::connect(place_.path, hand_controller("omega"), 0, 0.0)) {
    door_.hear(0);
  }
  void tell(std::int64_t arm_us) {
    door_.tell(arm_us, [](const Device&) { return state_of_test(); });
  }
  const ClockRelation& clock() { return door_.devices()[0]->clock(); }

  DeviceEndpoint place_;
  DeviceServer door_;
  Driver driver_;
};

TEST_F(AtADevice, TheWelcomeRelatesTheClocks) {
  EXPECT_FALSE(driver_.arm_ahead_us());
  driver_.receive(700);
  EXPECT_EQ(driver_.arm_ahead_us(), -700);
}

// The device's clock is 5 s ahead of the arm's; down 2 ms, up 3 ms: what is measured is half of both each way.
TEST_F(AtADevice, TheEchoTellsTheRoundTripAndTheQuickestTheClocks) {
  const std::int64_t ahead_us = -5'000'000;
  EXPECT_FALSE(clock().arm_ahead_us());
  for (int i = 1; i <= 5; ++i) {
    const std::int64_t arm_us = 20'000 * i, came_us = arm_us + 2'000 - ahead_us, slow_us = i == 3 ? 0 : 9'000;
    tell(arm_us);
    driver_.receive(came_us);
    driver_.send({.t_us = came_us + 500});
    driver_.send({.t_us = came_us + 900});  // the same echo: it has waited, and tells nothing
    door_.hear(arm_us + 2'000 + 500 + 3'000 + slow_us);
  }
  ASSERT_TRUE(clock().arm_ahead_us());
  EXPECT_EQ(*clock().arm_ahead_us(), ahead_us + 500);
  EXPECT_NEAR(clock().down_s(), 0.0025, 1e-9);
  EXPECT_NEAR(clock().up_s(), 0.0115, 1e-9) << "this one was slow";
}

TEST_F(AtADevice, AClockThatDriftsIsFollowed) {
  for (int i = 1; i <= 1000; ++i) {  // 20 s, 100 us in a second
    const std::int64_t arm_us = 20'000 * i, drift_us = 2 * i;
    tell(arm_us);
    driver_.receive(arm_us + 1'000 + drift_us);
    driver_.send({.t_us = arm_us + 1'000 + drift_us});
    door_.hear(arm_us + 2'000);
    door_.finish_interval(0.02);
  }
  EXPECT_NEAR(static_cast<double>(*clock().arm_ahead_us()), -2000.0, 100.0);
}

TEST_F(AtADevice, WithoutAnEchoTheClocksAreNotKnown) {
  tell(20'000);
  driver_.send({.t_us = 1});
  door_.hear(30'000);
  EXPECT_FALSE(clock().arm_ahead_us());
}

TEST_F(AtADevice, AStateIsToBeFeltOnlyWhileItIsFresh) {
  EXPECT_EQ(driver_.state(0), nullptr);
  tell(20'000);
  EXPECT_TRUE(driver_.receive(1'000));
  EXPECT_FALSE(driver_.receive(2'000)) << "nothing new";
  EXPECT_NE(driver_.state(101'000), nullptr);
  EXPECT_EQ(driver_.state(101'001), nullptr);
}

TEST_F(AtADevice, WhenLianadIsGoneThereIsNoStateAndTheDriverSaysWhy) {
  tell(20'000);
  door_.devices()[0]->refuse("for a test");
  EXPECT_TRUE(driver_.receive(1'000));
  EXPECT_FALSE(driver_.is_open());
  EXPECT_EQ(driver_.problem(), "refused: for a test");
  EXPECT_EQ(driver_.state(1'000), nullptr);
  EXPECT_FALSE(driver_.send({.t_us = 9}));
}

TEST_F(AtADevice, ACapabilityThatWouldBeRefusedIsRefusedAtOnce) {
  EXPECT_THROW(Driver::connect(place_.path, hand_controller(""), 0, 0.0), std::runtime_error);
  EXPECT_THROW(Driver::connect(place_.path + "x", hand_controller("a"), 0, 0.0), std::runtime_error);
}

}  // namespace
}  // namespace liana::device
