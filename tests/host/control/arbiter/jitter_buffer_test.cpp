// Samples of a hand behind a link whose delay varies, brought to one age.
#include "host/control/arbiter/jitter_buffer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "tests/host/control/arbiter/interval.hpp"

namespace liana::arbiter {
namespace {

constexpr std::int64_t kInterval_us = 20'000;
constexpr std::int64_t kHandClock_us = 7'000'000'000;  // ahead of the arm's

device::Sample sample_at(std::int64_t t_us, double x_m, bool deadman = true) {
  return {.t_us = t_us + kHandClock_us, .deadman = deadman, .pose = {{x_m, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}};
}

// A hand at 15 mm/s, sampled every `period_us`; what it sends in an interval is one packet, and one that was overtaken
// is dropped.
class HandBehindLink {
 public:
  HandBehindLink(std::int64_t period_us, double delay_s, double jitter_s)
      : period_us_(period_us), delay_s_(delay_s), jitter_s_(jitter_s) {}

  void vary(double delay_s, double jitter_s) {
    delay_s_ = delay_s;
    jitter_s_ = jitter_s;
  }
  // One interval on: what comes in it.
  std::vector<device::Sample> interval() {
    Packet packet{++sent_, now_us_ += kInterval_us, {}};
    packet.due_us += std::llround(1e6 * (delay_s_ + jitter_s_ * share_(random_)));
    for (; next_us_ <= now_us_; next_us_ += period_us_)
      packet.samples.push_back(sample_at(next_us_, 0.015e-6 * static_cast<double>(next_us_)));
    under_way_.push_back(packet);
    std::vector<device::Sample> came;
    std::ranges::stable_sort(under_way_, {}, &Packet::due_us);
    while (!under_way_.empty() && under_way_.front().due_us <= now_us_) {
      const Packet first = under_way_.front();
      under_way_.erase(under_way_.begin());
      if (first.number <= newest_) continue;
      newest_ = first.number;
      came.insert(came.end(), first.samples.begin(), first.samples.end());
    }
    return came;
  }
  std::int64_t now_us() const { return now_us_; }

 private:
  struct Packet {
    int number = 0;
    std::int64_t due_us = 0;
    std::vector<device::Sample> samples;
  };

  std::int64_t period_us_, now_us_ = 0, next_us_ = 1000;
  double delay_s_, jitter_s_;
  std::mt19937_64 random_{29};
  std::uniform_real_distribution<double> share_{-1.0, 1.0};
  std::vector<Packet> under_way_;
  int sent_ = 0, newest_ = 0;
};

std::optional<double> mean_m(const std::vector<device::Sample>& samples) {
  if (samples.empty()) return std::nullopt;
  double sum_m = 0.0;
  for (const device::Sample& s : samples) sum_m += s.pose.position_m[0];
  return sum_m / static_cast<double>(samples.size());
}

// Shortest and longest way in an interval, by the means of those that have samples; an interval without has none.
struct WaysAnInterval {
  double least_m = 1.0, most_m = 0.0;

  void add(std::optional<double> mean_m) {
    const double now_m = mean_m.value_or(before_m_);
    if (begun_) least_m = std::min(least_m, now_m - before_m_);
    if (begun_) most_m = std::max(most_m, now_m - before_m_);
    before_m_ = now_m;
    begun_ = begun_ || mean_m;
  }

 private:
  double before_m_ = 0.0;
  bool begun_ = false;
};

std::vector<device::Sample> interval(HandBehindLink& hand, JitterBuffer& age) {
  for (const device::Sample& s : hand.interval()) age.add(s);
  return age.finish_interval(kInterval_s);
}

TEST(JitterBuffer, WhileTheLinkIsEvenNothingWaits) {
  for (const std::int64_t period_us : {1000, 11111, 19000}) {
    HandBehindLink hand(period_us, 0.31, 0.0);
    JitterBuffer age;
    for (int i = 0; i < 1000; ++i) {
      const std::vector<device::Sample> came = hand.interval();
      for (const device::Sample& s : came) age.add(s);
      const std::vector<device::Sample> due = age.finish_interval(kInterval_s);
      ASSERT_EQ(due.size(), came.size()) << period_us << " us, interval " << i;
      for (std::size_t k = 0; k < due.size(); ++k) EXPECT_EQ(due[k].t_us, came[k].t_us);
    }
  }
}

// A link of 0.5 s that varies by 5 %: as it is heard of, the hand stands for whole intervals and then goes three times
// as far as in one; brought to one age it goes evenly.
// req:A32
TEST(JitterBuffer, BehindAVaryingDelayAHandThatGoesEvenlyIsFollowedEvenly) {
  HandBehindLink hand(1000, 0.5, 0.025);
  JitterBuffer age;
  WaysAnInterval heard, followed;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<device::Sample> came = hand.interval();
    for (const device::Sample& s : came) age.add(s);
    const std::vector<device::Sample> due = age.finish_interval(kInterval_s);
    if (i < 150) continue;  // it learns
    heard.add(mean_m(came));
    followed.add(mean_m(due));
    ASSERT_FALSE(due.empty()) << i;
    EXPECT_LE(hand.now_us() + kHandClock_us - due.back().t_us, 545'000) << "no older than the slowest";
  }
  EXPECT_EQ(heard.least_m, 0.0);
  EXPECT_GT(heard.most_m, 2.5 * 0.0003);
  EXPECT_GT(followed.least_m, 0.8 * 0.0003);
  EXPECT_LT(followed.most_m, 1.2 * 0.0003);
}

TEST(JitterBuffer, AWaitThatHasBecomeShorterIsMadeUpForSlowly) {
  HandBehindLink hand(1000, 0.5, 0.025);
  JitterBuffer age;
  for (int i = 0; i < 500; ++i) interval(hand, age);
  hand.vary(0.5, 0.0);
  for (int i = 0; i < 5; ++i) interval(hand, age);
  WaysAnInterval followed;
  for (int i = 0; i < 1000; ++i) followed.add(mean_m(interval(hand, age)));
  EXPECT_LT(followed.most_m, 1.1 * 0.0003);
  const std::vector<device::Sample> due = interval(hand, age);
  ASSERT_FALSE(due.empty());
  EXPECT_EQ(due.back().t_us, hand.now_us() - 500'000 + kHandClock_us) << "nothing waits any more";
}

TEST(JitterBuffer, AnOpenDeadmanWaitsForNothing) {
  HandBehindLink hand(1000, 0.5, 0.025);
  JitterBuffer age;
  for (int i = 0; i < 500; ++i) interval(hand, age);
  std::vector<device::Sample> came = hand.interval();
  while (came.empty()) {
    age.finish_interval(kInterval_s);
    came = hand.interval();
  }
  came.back().deadman = false;
  for (const device::Sample& s : came) age.add(s);
  EXPECT_EQ(age.finish_interval(kInterval_s).back().t_us, came.back().t_us);
}

// The arm is let go then, whatever waits.
TEST(JitterBuffer, ASilenceIsNotWaitedFor) {
  HandBehindLink hand(1000, 0.5, 0.025);
  JitterBuffer age;
  for (int i = 0; i < 500; ++i) interval(hand, age);
  for (int i = 0; i < 50; ++i) {
    hand.interval();
    age.finish_interval(kInterval_s);
  }
  for (int i = 0; i < 50; ++i) interval(hand, age);
  const std::vector<device::Sample> due = interval(hand, age);
  ASSERT_FALSE(due.empty());
  EXPECT_LE(hand.now_us() + kHandClock_us - due.back().t_us, 500'000 + 25'000 + JitterBuffer::kMaxWait_us);
}

// The link has become slower by 0.3 s: said, until the deadman was open; then that is the age.
TEST(JitterBuffer, NewsThatIsOlderThanEverIsLateUntilTheDeadmanOpens) {
  HandBehindLink hand(5000, 0.1, 0.0);
  JitterBuffer age;
  for (int i = 0; i < 100; ++i) interval(hand, age);
  EXPECT_FALSE(age.is_late());
  hand.vary(0.4, 0.0);
  for (int i = 0; i < 40; ++i) interval(hand, age);
  EXPECT_TRUE(age.is_late());
  std::vector<device::Sample> came = hand.interval();
  ASSERT_FALSE(came.empty());
  came.back().deadman = false;
  for (const device::Sample& s : came) age.add(s);
  age.finish_interval(kInterval_s);
  for (int i = 0; i < 10; ++i) interval(hand, age);
  EXPECT_FALSE(age.is_late());
}

// A clock that is quicker than the arm's makes every sample younger than those before it: none waits longer for that.
TEST(JitterBuffer, BehindAClockThatIsTooQuickNoSampleWaitsLongerThanTheLongest) {
  JitterBuffer age;
  std::int64_t t_us = 0, played_us = 0;
  for (int i = 0; i < 1500; ++i) {
    for (int k = 0; k < 2; ++k) age.add(sample_at(t_us += 11'000, 1e-4 * i));
    const std::vector<device::Sample> due = age.finish_interval(kInterval_s);
    if (!due.empty()) played_us = due.back().t_us;
    ASSERT_LE(t_us + kHandClock_us - played_us, JitterBuffer::kMaxWait_us + 22'000) << i;
  }
}

}  // namespace
}  // namespace liana::arbiter
