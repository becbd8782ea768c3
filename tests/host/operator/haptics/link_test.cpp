// The link's fate of packets, and what the receivers make of it (req:A12).
#include "host/operator/haptics/link.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "host/operator/haptics/packets.hpp"
#include "tests/message.hpp"

namespace liana::haptics {
namespace {

struct Arrival {
  std::uint32_t sequence;
  std::int64_t at_us;
  bool operator==(const Arrival&) const = default;
};

// A packet every 20 ms for 20 s.
std::vector<Arrival> arrivals(const LinkTable& table, std::uint64_t seed) {
  Link<CommandPacket> link(table, seed, 1);
  std::vector<Arrival> all;
  for (std::int64_t now_us = 0; now_us < 30000000; now_us += 1000) {
    const auto sequence = static_cast<std::uint32_t>(now_us / 20000);
    if (now_us % 20000 == 0 && sequence < 1000) link.send({sequence, now_us, {}}, now_us);
    while (const auto packet = link.receive(now_us)) all.push_back({packet->sequence, now_us});
  }
  return all;
}

// req:C13
TEST(Link, EveryPacketTakesTheDelay) {
  for (const double delay_s : {0.0, 0.05, 1.0, 2.0}) {
    const auto all = arrivals({delay_s, 0.0, 0.0}, 1);
    ASSERT_EQ(all.size(), 1000U);
    for (std::uint32_t i = 0; i < 1000; ++i) {
      ASSERT_EQ(all[i].sequence, i);
      ASSERT_EQ(all[i].at_us, 20000 * std::int64_t{i} + static_cast<std::int64_t>(1e6 * delay_s));
    }
  }
}

TEST(Link, JitterStaysInItsShareAndLetsPacketsOvertake) {
  int overtaken = 0;
  const auto all = arrivals({1.0, 0.2, 0.0}, 7);
  ASSERT_EQ(all.size(), 1000U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::int64_t delay_us = all[i].at_us - 20000 * std::int64_t{all[i].sequence};
    ASSERT_GE(delay_us, 800000);
    ASSERT_LE(delay_us, 1201000);
    if (i > 0 && all[i].sequence < all[i - 1].sequence) ++overtaken;
  }
  EXPECT_GT(overtaken, 100);
}

TEST(Link, LosesTheShareThatItIsTold) {
  const auto all = arrivals({0.1, 0.0, 0.3}, 3);
  EXPECT_NEAR(static_cast<double>(all.size()), 700.0, 60.0);
}

TEST(Link, TheSameSeedGivesEveryPacketTheSameFate) {
  const LinkTable table{0.5, 0.2, 0.1};
  EXPECT_EQ(arrivals(table, 4), arrivals(table, 4));
  EXPECT_NE(arrivals(table, 4), arrivals(table, 5));
}

TEST(Link, ATableOutOfRangeIsRefusedByName) {
  const auto refusal = [](const LinkTable& table) -> std::string {
    try {
      Link<CommandPacket> link(table, 1, 1);
      return "accepted";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_TRUE(names(refusal({5.1, 0.0, 0.0}), {"link", "delay_s", "5.1"}));
  EXPECT_NE(refusal({1.0, 1.1, 0.0}).find("jitter"), std::string::npos);
  EXPECT_NE(refusal({1.0, 0.0, -0.1}).find("loss"), std::string::npos);
}

TEST(Newest, LetsNothingThroughThatIsOlderOrTheSame) {
  struct Row {
    std::uint32_t sequence;
    bool accepted;
  };
  Newest newest;
  for (const Row& row : {Row{4294967290U, true}, Row{4294967294U, true}, Row{4294967293U, false},
                         Row{4294967294U, false}, Row{2U, true}, Row{4294967295U, false}, Row{3U, true}})
    EXPECT_EQ(newest.accept(row.sequence), row.accepted) << row.sequence;
  EXPECT_EQ(newest.dropped(), 3);
}

}  // namespace
}  // namespace liana::haptics
