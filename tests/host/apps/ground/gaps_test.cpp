// Gaps by sequence counts: found, filled, asked for again, given up; and the file that has each packet once (req:A25).
#include "host/apps/ground/gaps.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "host/apps/ground/ground_store.hpp"

namespace liana::ground {
namespace {

constexpr std::uint64_t kStep_us = 100000;

// Takes packets `first` to `last`, each of a time that goes with its number.
void take(Gaps& gaps, unsigned first, unsigned last, double now_s) {
  for (unsigned i = first; i <= last; ++i)
    gaps.take(kArmApid, static_cast<std::uint16_t>(i % kCountModulus), kStep_us * i, now_s);
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
  file.begin(gaps);
  gaps.take(kArmApid, 43, 8000000, 0.0);
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
