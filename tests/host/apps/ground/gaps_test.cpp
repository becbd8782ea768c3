// Gaps by sequence counts: found, filled, asked for again, given up; and the file that has each packet once (req:A25).
#include "host/apps/ground/gaps.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "host/apps/ground/ground_store.hpp"

namespace liana::ground {
namespace {

constexpr std::uint64_t kStep_us = 100000;

// Packet `number` of an on-board end that was started at `begin_us`: one in three is an event, the others are states.
Telemetry sent(unsigned number, std::uint64_t begin_us = 0) {
  Telemetry out;
  out.primary = {0, false, true, kArmApid, 3, static_cast<std::uint16_t>(number % kCountModulus), 1};
  out.service = number % 3 == 0 ? 5 : 3;
  out.subtype = 25;
  out.message_count = static_cast<std::uint16_t>(number % 3 == 0 ? number / 3 : number - number / 3 - 1);
  out.time_us = begin_us + kStep_us * number;
  return out;
}

// Packet `number` of the other APID.
Telemetry time_sent(unsigned number, std::uint64_t begin_us = 0) {
  Telemetry out;
  out.primary = {0, false, false, kTimeApid, 3, static_cast<std::uint16_t>(number % kCountModulus), 1};
  out.data = std::string(1, '\0');
  append_time(out.data, begin_us + kStep_us * number);
  return out;
}

// Takes packets `first` to `last`.
void take(Gaps& gaps, unsigned first, unsigned last, double now_s, std::uint64_t begin_us = 0) {
  for (unsigned i = first; i <= last; ++i) gaps.take(sent(i, begin_us), now_s);
}

TEST(Gaps, AreNoneInACountThatBeginsAnewAtItsEnd) {
  Gaps gaps;
  take(gaps, 100, 40000, 0.0);
  EXPECT_EQ(gaps.found(), 0u);
  EXPECT_FALSE(gaps.ask(100.0));
}

TEST(Gaps, AreAskedForByTheTimesBesideThemAfterAGrace) {
  Gaps gaps;
  take(gaps, 16380, 16382, 0.0);
  take(gaps, 16390, 16395, 10.0);
  EXPECT_EQ(gaps.found(), 7u);
  EXPECT_FALSE(gaps.ask(10.5));
  const auto span = gaps.ask(11.0);
  ASSERT_TRUE(span);
  EXPECT_EQ(span->from_us, 16382 * kStep_us);
  EXPECT_EQ(span->to_us, 16390 * kStep_us);
  EXPECT_FALSE(gaps.ask(12.0));
  take(gaps, 16383, 16389, 12.0);
  EXPECT_EQ(gaps.filled(), 7u);
  EXPECT_EQ(gaps.open(), 0u);
  EXPECT_FALSE(gaps.ask(100.0));
}

TEST(Gaps, OfPacketsThatWereOvertakenCloseBeforeAnybodyIsAsked) {
  Gaps gaps;
  take(gaps, 1, 5, 0.0);
  take(gaps, 7, 7, 0.0);
  take(gaps, 6, 6, 0.1);
  take(gaps, 8, 8, 0.2);
  take(gaps, 7, 7, 0.3);
  EXPECT_EQ(gaps.found(), 1u);
  EXPECT_EQ(gaps.filled(), 1u);
  EXPECT_FALSE(gaps.ask(100.0));
}

TEST(Gaps, AreGivenUpAfterTheLastTry) {
  Gaps gaps;
  take(gaps, 1, 1, 0.0);
  take(gaps, 4, 4, 0.0);
  int questions = 0;
  for (double now_s = 0.0; now_s < 200.0; now_s += 0.5) questions += gaps.ask(now_s) ? 1 : 0;
  EXPECT_EQ(questions, Gaps::kMaxTries);
  EXPECT_EQ(gaps.lost(), 2u);
  EXPECT_EQ(gaps.open(), 0u);
}

TEST(Gaps, BeyondTheirNumberCountAsLostAtOnce) {
  Gaps gaps;
  for (unsigned i = 0; i < Gaps::kMaxGaps + 10; ++i) take(gaps, 2 * i, 2 * i, 0.0);
  EXPECT_EQ(gaps.open(), Gaps::kMaxGaps);
  EXPECT_EQ(gaps.lost(), 9u);
  take(gaps, 1, 1, 0.0);
  EXPECT_EQ(gaps.open(), Gaps::kMaxGaps) << "the oldest was given up";
  take(gaps, 2 * Gaps::kMaxGaps + 17, 2 * Gaps::kMaxGaps + 17, 0.0);
  EXPECT_EQ(gaps.open(), Gaps::kMaxGaps - 1) << "the newest was kept";
}

constexpr std::uint64_t kLater_us = 10000000000;  // the on-board end was started anew then

TEST(Gaps, OfAnOnBoardEndThatCountsAnewAreNoLoss) {
  struct Row {
    const char* why;
    unsigned last, first;  // of the old life and of the new one
  };
  const Row rows[] = {
      {"from its first packet on", 9000, 0},        {"its first packets had no reader yet", 9000, 20},
      {"after a wrap of the old counts", 40000, 3}, {"old counts near their end", 16380, 2},
      {"it has sent for a while", 9000, 8000},
  };
  for (const Row& row : rows) {
    Gaps gaps;
    take(gaps, row.last - 100, row.last, 0.0);
    take(gaps, row.first, row.first + 100, 10.0, kLater_us);
    EXPECT_EQ(gaps.found(), 0u) << row.why;
    int questions = 0;
    for (double now_s = 10.0; now_s < 200.0; now_s += 0.5) questions += gaps.ask(now_s) ? 1 : 0;
    EXPECT_EQ(questions, 1) << row.why << ": it may have been a long outage";
    EXPECT_EQ(gaps.lost(), 0u) << row.why;
    EXPECT_EQ(gaps.open(), 0u) << row.why;
    take(gaps, row.first + 103, row.first + 103, 200.0, kLater_us);
    EXPECT_EQ(gaps.found(), 2u) << row.why << ": of the new life";
  }
}

TEST(Gaps, OfAnotherApidAcrossTheStartAreNoneEither) {
  for (const bool time_comes_first : {true, false}) {
    Gaps gaps;
    for (unsigned i = 0; i < 200; ++i) gaps.take(time_sent(i), 0.0);
    take(gaps, 0, 200, 0.0);
    for (unsigned i = 200; i < 250; ++i) gaps.take(time_sent(i), 5.0);  // the last that the first life says
    if (time_comes_first) gaps.take(time_sent(0, kLater_us - 2 * kStep_us), 10.0);
    take(gaps, 0, 10, 10.0, kLater_us);
    for (unsigned i = 1; i < 10; ++i) gaps.take(time_sent(i, kLater_us), 10.0);
    EXPECT_EQ(gaps.found(), 0u) << time_comes_first;
  }
}

// Property: of one life, whatever is cut out of it, nothing is taken for a start.
TEST(Gaps, OfOneLifeAreFoundWhereverItIsCut) {
  std::mt19937 engine(37);
  for (int n = 0; n < 300; ++n) {
    Gaps gaps;
    const unsigned last = std::uniform_int_distribution(10u, 60000u)(engine);
    const unsigned cut = std::uniform_int_distribution(1u, kCountModulus - 2u)(engine);
    take(gaps, last - 10, last, 0.0);
    take(gaps, last + cut + 1, last + cut + 5, 0.0);
    ASSERT_EQ(gaps.found(), cut) << last;
    ASSERT_EQ(gaps.open(), 1u);
  }
}

TEST(PacketFile, ShowsAfterAStartWhatWasMissingBefore) {
  const std::string path = std::filesystem::path(::testing::TempDir()) / "gaps.db";
  std::filesystem::remove(path);
  {
    PacketFile file(path, archive::Database::Open::kQuick);
    for (unsigned i = 16300; i < 16500; ++i) {
      Telemetry packet = sent(i), time = time_sent(i);
      packet.time_us -= packet.time_us % (5 * kStep_us);  // five have one time, and 16383 and 0 are among them
      if (i < 16400 || i >= 16420) file.add(packet, telemetry_bytes(packet));
      file.add(time, telemetry_bytes(time));
    }
    file.commit();
  }
  PacketFile file(path, archive::Database::Open::kRead);
  Gaps gaps;
  file.begin(gaps, 100.0);
  EXPECT_EQ(gaps.found(), 20u);
  EXPECT_FALSE(gaps.ask(100.5));
  const auto span = gaps.ask(101.0);
  ASSERT_TRUE(span);
  EXPECT_EQ(span->from_us, 16395 * kStep_us);
  EXPECT_EQ(span->to_us, 16420 * kStep_us);
  for (unsigned i = 16400; i < 16420; ++i) {
    Telemetry packet = sent(i);
    packet.time_us -= packet.time_us % (5 * kStep_us);
    gaps.take(packet, 102.0);
  }
  EXPECT_EQ(gaps.filled(), 20u);
  EXPECT_EQ(gaps.open(), 0u);
}

TEST(PacketFile, KeepsEachPacketOnceAndGoesOnWhereItEnded) {
  const std::string path = std::filesystem::path(::testing::TempDir()) / "packets.db";
  std::filesystem::remove(path);
  Telemetry telemetry;
  telemetry.primary = {0, false, true, kArmApid, 3, 41, 1};
  telemetry.service = 3;
  telemetry.subtype = 25;
  telemetry.time_us = 7000000;
  const std::string packet = telemetry_bytes(telemetry);
  {
    PacketFile file(path, archive::Database::Open::kQuick);
    EXPECT_TRUE(file.add(telemetry, packet));
    EXPECT_FALSE(file.add(telemetry, packet));
    file.commit();
  }
  PacketFile file(path, archive::Database::Open::kQuick);
  Gaps gaps;
  file.begin(gaps, 0.0);
  Telemetry next = telemetry;
  next.primary.count = 43, next.message_count = 1, next.time_us = 8000000;
  gaps.take(next, 0.0);
  EXPECT_EQ(gaps.found(), 1u);
  std::vector<std::string> all;
  file.read([&](const std::string& each) { all.push_back(each); });
  EXPECT_EQ(all, std::vector{packet});
  telemetry.time_us = 7000000 + 86400000001;
  telemetry.primary.count = 42;
  file.add(telemetry, telemetry_bytes(telemetry));
  file.remove_old(86400.0);
  file.commit();
  all.clear();
  file.read([&](const std::string& each) { all.push_back(each); });
  EXPECT_EQ(all, std::vector{telemetry_bytes(telemetry)});
}

}  // namespace
}  // namespace liana::ground
