// Telemetry is counted without gaps, and the store keeps the newest of it.
#include "host/apps/ground/downlink.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace liana::ground {
namespace {

struct Line {
  explicit Line(std::size_t store_bytes = 1000000)
      : downlink(store_bytes, [this](const std::string& packet) { packets.push_back(packet); }) {}
  void report(std::uint64_t time_us) { downlink.report(3, 25, 0, time_us, "data"); }
  std::vector<std::string> packets;
  Downlink downlink;
};

TEST(Downlink, CountsThePacketsOfAnApidOverTheWholeRange) {
  Line line;
  for (unsigned i = 0; i <= kCountModulus; ++i) line.report(i);
  EXPECT_EQ(read_telemetry(line.packets[16383])->primary.count, 16383);
  EXPECT_EQ(read_telemetry(line.packets[16384])->primary.count, 0);
  EXPECT_EQ(read_telemetry(line.packets[16384])->message_count, 16384);
  line.downlink.time_packet(0, "time");
  EXPECT_EQ(read_telemetry(line.packets.back())->primary.count, 0);
}

TEST(Downlink, NeverLetsTimeGoBack) {
  Line line;
  line.report(5000000);
  line.report(4000000);
  EXPECT_EQ(read_telemetry(line.packets[1])->time_us, 5000000u);
}

TEST(Downlink, SendsTheSameOctetsAgainForASpanOfTime) {
  Line line;
  for (std::uint64_t i = 0; i < 10; ++i) line.report(1000 * i);
  const std::vector<std::string> sent = line.packets;
  ASSERT_TRUE(line.downlink.begin_resend(3000, 6000));
  EXPECT_FALSE(line.downlink.begin_resend(0, 1));
  line.downlink.go_on_resending(3);
  EXPECT_TRUE(line.downlink.is_resending());
  line.downlink.go_on_resending(3);
  EXPECT_FALSE(line.downlink.is_resending());
  EXPECT_EQ(std::vector(line.packets.begin() + 10, line.packets.end()),
            std::vector(sent.begin() + 3, sent.begin() + 7));
  EXPECT_EQ(line.downlink.sent(), 10u);
  EXPECT_TRUE(line.downlink.begin_resend(20000, 30000));
  EXPECT_FALSE(line.downlink.is_resending());
}

TEST(Downlink, KeepsTheNewestPacketsWithinItsBytesAlsoDuringAResend) {
  constexpr std::size_t kPacket = kPrimaryBytes + kTelemetryHeaderBytes + 4 + kChecksumBytes;
  Line line(10 * kPacket);
  for (std::uint64_t i = 0; i < 25; ++i) line.report(i);
  EXPECT_EQ(line.downlink.stored(), 10u);
  EXPECT_EQ(line.downlink.dropped(), 15u);
  ASSERT_TRUE(line.downlink.begin_resend(15, 24));
  line.downlink.go_on_resending(2);
  line.packets.clear();
  for (std::uint64_t i = 25; i < 30; ++i) line.report(i);
  line.packets.clear();
  line.downlink.go_on_resending(100);
  ASSERT_EQ(line.packets.size(), 5u);  // two were sent before, three are gone
  EXPECT_EQ(read_telemetry(line.packets.front())->time_us, 20u);
}

}  // namespace
}  // namespace liana::ground
