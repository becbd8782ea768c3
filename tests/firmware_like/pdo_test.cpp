#include "firmware_like/drive/pdo.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

#include "firmware_like/math/convert.hpp"
#include "tests/firmware_like/extremes.hpp"

namespace liana {
namespace {

TEST(Pdo, Rpdo1IsControlwordThenTargetLittleEndian) {
  EXPECT_EQ(encode_rpdo1({0x000F, 0x12345678}), (std::array<std::uint8_t, 6>{0x0F, 0x00, 0x78, 0x56, 0x34, 0x12}));
  EXPECT_EQ(encode_rpdo1({0x8001, -2}), (std::array<std::uint8_t, 6>{0x01, 0x80, 0xFE, 0xFF, 0xFF, 0xFF}));
  EXPECT_EQ(encode_rpdo1({0, kIntMin}), (std::array<std::uint8_t, 6>{0, 0, 0, 0, 0, 0x80}));
}

TEST(Pdo, Tpdo1IsStatuswordPositionTorqueLittleEndian) {
  const std::array<std::uint8_t, 8> bytes{0x37, 0x12, 0x40, 0x42, 0x0F, 0x00, 0x18, 0xFC};
  Tpdo1 report{};
  ASSERT_TRUE(decode_tpdo1(bytes, report));
  EXPECT_EQ(report.statusword, 0x1237);
  EXPECT_EQ(report.position_counts, 1000000);
  EXPECT_EQ(report.torque_permille, -1000);
  EXPECT_EQ(encode_tpdo1(report), bytes);
}

TEST(Pdo, ATorqueDriveHasTorqueAndRateInItsCommandAndItsRateInASecondReport) {
  const DriveCommand sent{0x800F, 77, -2, 0x12345678};
  const std::array<std::uint8_t, 8> bytes{0x0F, 0x80, 0xFE, 0xFF, 0x78, 0x56, 0x34, 0x12};
  EXPECT_EQ(encode_torque_rpdo1(sent), bytes);
  DriveCommand received{};
  ASSERT_TRUE(decode_torque_rpdo1(bytes, received));
  EXPECT_EQ(received.controlword, sent.controlword);
  EXPECT_EQ(received.torque_permille, sent.torque_permille);
  EXPECT_EQ(received.rate_counts_s, sent.rate_counts_s);
  std::int32_t rate_counts_s = 0;
  ASSERT_TRUE(decode_tpdo2(std::array<std::uint8_t, 4>{0xFE, 0xFF, 0xFF, 0xFF}, rate_counts_s));
  EXPECT_EQ(rate_counts_s, -2);
}

TEST(Pdo, WhatIsEncodedIsDecodedForExtremesAndRandomValues) {
  std::mt19937 random(402);
  std::vector<std::int32_t> positions{0, 1, -1, kIntMax, kIntMin};
  for (int i = 0; i < 1000; ++i) positions.push_back(static_cast<std::int32_t>(random()));
  for (const std::int32_t position : positions) {
    const DriveCommand sent{static_cast<std::uint16_t>(random()), position};
    DriveCommand received{};
    ASSERT_TRUE(decode_rpdo1(encode_rpdo1(sent), received));
    EXPECT_EQ(received.controlword, sent.controlword);
    EXPECT_EQ(received.target_counts, sent.target_counts);
    const Tpdo1 reported{static_cast<std::uint16_t>(random()), position, static_cast<std::int16_t>(random())};
    Tpdo1 read{};
    ASSERT_TRUE(decode_tpdo1(encode_tpdo1(reported), read));
    EXPECT_EQ(read.statusword, reported.statusword);
    EXPECT_EQ(read.position_counts, reported.position_counts);
    EXPECT_EQ(read.torque_permille, reported.torque_permille);
  }
}

TEST(Pdo, AFrameOfAnyOtherLengthIsRefusedAndChangesNothing) {
  const std::vector<std::uint8_t> bytes(16, 0xAA);
  for (std::size_t length = 0; length <= bytes.size(); ++length) {
    const std::span<const std::uint8_t> data(bytes.data(), length);
    DriveCommand command{7, 7};
    Tpdo1 report{7, 7, 7};
    EXPECT_EQ(decode_rpdo1(data, command), length == 6);
    EXPECT_EQ(decode_tpdo1(data, report), length == 8);
    EXPECT_EQ(command.target_counts == 7, length != 6);
    EXPECT_EQ(report.position_counts == 7, length != 8);
    Tpdo1 without{7, 7, 7};
    EXPECT_EQ(decode_tpdo1(data, without, false), length == 6) << "of a drive that reports no torque";
    EXPECT_EQ(without.torque_permille, length == 6 ? 0 : 7);
    DriveCommand of_torque{7, 7, 7, 7};
    std::int32_t rate_counts_s = 7;
    EXPECT_EQ(decode_torque_rpdo1(data, of_torque), length == 8);
    EXPECT_EQ(decode_tpdo2(data, rate_counts_s), length == 4);
    EXPECT_EQ(of_torque.rate_counts_s == 7, length != 8);
    EXPECT_EQ(rate_counts_s == 7, length != 4);
  }
}

TEST(Pdo, CobIdsFollowThePredefinedConnectionSet) {
  EXPECT_EQ(rpdo1_cob_id(15), 0x20FU);
  EXPECT_EQ(tpdo1_cob_id(1), 0x181U);
  EXPECT_EQ(kSyncCobId, 0x080U);
}

struct CountCase {
  double value;
  std::int32_t counts;
  CountStatus status;
};

TEST(Convert, FloatingPointBecomesTheNearestCountAndSaysWhenItCannot) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  const std::vector<CountCase> cases{
      {0.0, 0, CountStatus::kExact},
      {-0.0, 0, CountStatus::kExact},
      {0.5, 1, CountStatus::kExact},
      {-0.5, -1, CountStatus::kExact},
      {0.49999999999999994, 0, CountStatus::kExact},  // adding 0.5 and truncating would give 1
      {2.5, 3, CountStatus::kExact},
      {5e-324, 0, CountStatus::kExact},
      {2147483646.5, kIntMax, CountStatus::kExact},
      {2147483647.0, kIntMax, CountStatus::kExact},
      {2147483647.0000005, kIntMax, CountStatus::kSaturated},
      {-2147483648.0, kIntMin, CountStatus::kExact},
      {-2147483648.5, kIntMin, CountStatus::kSaturated},
      {1e300, kIntMax, CountStatus::kSaturated},
      {kInf, kIntMax, CountStatus::kSaturated},
      {-kInf, kIntMin, CountStatus::kSaturated},
      {std::numeric_limits<double>::quiet_NaN(), 0, CountStatus::kNotANumber},
  };
  for (const CountCase& one : cases) {
    const Counts counts = to_counts(one.value);
    EXPECT_EQ(counts.value, one.counts) << one.value;
    EXPECT_EQ(counts.status, one.status) << one.value;
  }
}

TEST(Convert, NarrowingClampsInsteadOfWrapping) {
  EXPECT_EQ(narrow<std::int16_t>(40000), 32767);
  EXPECT_EQ(narrow<std::int16_t>(-40000), -32768);
  EXPECT_EQ(narrow<std::uint8_t>(-1), 0);
  EXPECT_EQ(narrow<std::uint8_t>(255), 255);
  EXPECT_EQ(narrow<std::uint8_t>(256), 255);
  EXPECT_EQ(narrow<std::int32_t>(std::numeric_limits<std::size_t>::max()), kIntMax);
  EXPECT_EQ(as_index(-3), 0U);
  EXPECT_EQ(as_index(31), 31U);
}

}  // namespace
}  // namespace liana
