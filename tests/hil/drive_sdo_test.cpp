// The drive as a CANopen node: boot-up, objects, abort codes, segmented transfer, re-mapping.
#include "drive_harness.hpp"

namespace liana::bench {
namespace {

class DriveNode : public DriveHarness {};

TEST_F(DriveNode, BootsUpOnceAndAgainAfterResetCommunication) {
  const FrameList first = tick();
  ASSERT_EQ(first.size(), 1U);
  EXPECT_EQ(first[0].id, 0x700 + kNode);
  EXPECT_EQ(first[0].length, 1);
  EXPECT_EQ(first[0].data[0], 0);
  EXPECT_TRUE(tick(4000).empty());
  EXPECT_EQ(write(0x1017, 0, 2, 100), 0U);
  EXPECT_TRUE(give(0x000, {0x82, kNode + 1}).empty()) << "another node's reset";
  EXPECT_TRUE(find(give(0x000, {0x82, 0}), 0x700 + kNode));
  EXPECT_EQ(read(0x1017, 0), 0U) << "communication objects are back to power-on values";
}

TEST_F(DriveNode, SendsHeartbeatsWithItsStateAtTheWrittenPeriod) {
  boot();
  write(0x1017, 0, 2, 100);
  int count = 0;
  for (int i = 0; i < 250; ++i) {
    const auto heartbeat = find(tick(4000), 0x700 + kNode);
    count += heartbeat ? 1 : 0;
    EXPECT_EQ(heartbeat ? heartbeat->data[0] : (i < 125 ? 0x7F : 0x05), i < 125 ? 0x7F : 0x05);
    if (i == 124) give(0x000, {0x01, 0});
  }
  EXPECT_NEAR(count, 10, 1);
}

TEST_F(DriveNode, TellsItsIdentityAndScaling) {
  boot();
  EXPECT_EQ(read(0x1000, 0), 0x00020192U);
  EXPECT_EQ(read(0x1018, 1), 0x4C49U);
  EXPECT_EQ(read(0x1018, 4), 70412U);
  EXPECT_EQ(read(0x608F, 1), 65536U);
  EXPECT_EQ(read(0x608F, 2), 1U);
  EXPECT_EQ(read(0x6076, 0), 9000U);
  EXPECT_EQ(read(0x6502, 0), 0x80U);
  EXPECT_EQ(read(0x6064, 0), 1000U);
}

TEST_F(DriveNode, RefusesWithTheCodeOfTheStandard) {
  boot();
  struct Case {
    const char* reason;
    std::uint16_t index;
    std::uint8_t sub;
    std::size_t size;
    std::uint32_t value;
    std::uint32_t code;
  };
  const Case cases[] = {
      {"no such object", 0x2000, 0, 4, 0, 0x06020000},
      {"no such sub-index", 0x1018, 9, 4, 0, 0x06090011},
      {"read-only", 0x1000, 0, 4, 0, 0x06010002},
      {"too long", 0x1017, 0, 4, 100, 0x06070012},
      {"too short", 0x607A, 0, 2, 100, 0x06070013},
      {"too high", 0x6072, 0, 2, 3001, 0x06090031},
      {"too low", 0x605A, 0, 2, 0, 0x06090032},
      {"mode not supported", 0x6060, 0, 1, 1, 0x06090030},
      {"mapping while enabled", 0x1600, 0, 1, 0, 0x08000022},
      {"COB-ID changed while enabled", 0x1400, 1, 4, 0x300, 0x06090030},
  };
  for (const auto& test : cases)
    EXPECT_EQ(write(test.index, test.sub, test.size, test.value), test.code) << test.reason;
  EXPECT_EQ(aborted(sdo({0xC0, 0x00, 0x10, 0})), 0x05040001U) << "block transfer";
  EXPECT_FALSE(read(0x2000, 0));
  EXPECT_EQ(aborted(last_), 0x06020000U);
}

TEST_F(DriveNode, MapsOnlyWhatCanBeMappedAndOnlyInOrder) {
  boot();
  EXPECT_EQ(write(0x1600, 1, 4, 0x60400010), 0x08000022U) << "before disabling";
  EXPECT_EQ(write(0x1400, 1, 4, 0x80000205), 0U);
  EXPECT_EQ(write(0x1600, 1, 4, 0x10000020), 0x06040041U) << "not mappable";
  EXPECT_EQ(write(0x1600, 1, 4, 0x60410010), 0x06040041U) << "read-only in an RPDO";
  EXPECT_EQ(write(0x1600, 1, 4, 0x60400020), 0x06040041U) << "wrong bit length";
  EXPECT_EQ(write(0x1600, 1, 4, 0x23450010), 0x06020000U) << "no such object";
  for (std::uint8_t i = 1; i <= 3; ++i) EXPECT_EQ(write(0x1600, i, 4, 0x607A0020), 0U);
  EXPECT_EQ(write(0x1600, 0, 1, 3), 0x06040042U) << "12 bytes";
  EXPECT_EQ(write(0x1600, 0, 1, 2), 0U);
  EXPECT_EQ(write(0x1600, 1, 4, 0x60400010), 0x06010000U) << "entries while the count stands";
  EXPECT_EQ(write(0x1400, 1, 4, 0x205), 0U);
  give(0x000, {0x01, kNode});
  EXPECT_EQ(write(0x1400, 1, 4, 0x80000205), 0x08000022U) << "only in pre-operational";
}

TEST_F(DriveNode, ReadsALongTextInSegmentsAndWatchesTheToggle) {
  boot();
  auto answer = sdo({0x40, 0x08, 0x10, 0});
  ASSERT_EQ(answer[0], 0x41);
  const std::size_t size = get_little_endian(&answer[4], 4);
  std::string text;
  for (std::uint8_t toggle = 0;; toggle ^= 0x10) {
    answer = sdo({static_cast<std::uint8_t>(0x60 | toggle)});
    ASSERT_EQ(answer[0] & 0xF0, toggle);
    text.append(answer.begin() + 1, answer.begin() + 8 - ((answer[0] >> 1) & 7));
    if ((answer[0] & 1) != 0) break;
  }
  EXPECT_EQ(text, "Liana bench drive");
  EXPECT_EQ(text.size(), size);
  sdo({0x40, 0x08, 0x10, 0});
  EXPECT_EQ(aborted(sdo({0x70})), 0x05030000U);
  EXPECT_EQ(aborted(sdo({0x60})), 0x05040001U) << "the transfer is over";
}

TEST_F(DriveNode, TakesAValueInSegments) {
  boot();
  EXPECT_EQ(sdo({0x21, 0x7A, 0x60, 0, 4})[0], 0x60);
  EXPECT_EQ(sdo({0x00 | (3 << 1) | 1, 0x78, 0x56, 0x34, 0x12})[0], 0x20);
  EXPECT_EQ(read(0x607A, 0), 0x12345678U);
  sdo({0x21, 0x17, 0x10, 0, 4});
  EXPECT_EQ(aborted(sdo({0x00 | (3 << 1) | 1, 1, 2, 3, 4})), 0x06070012U) << "four bytes for a u16";
}

TEST_F(DriveNode, AnswersNoSdoWhenStoppedAndSendsNothingWhenSilentOrDead) {
  boot();
  give(0x000, {0x02, kNode});
  EXPECT_TRUE(sdo({0x40, 0x00, 0x10, 0}).empty());
  give(0x000, {0x80, kNode});
  EXPECT_TRUE(read(0x1000, 0));
  drive_.defects().silent = true;
  EXPECT_TRUE(sdo({0x40, 0x00, 0x10, 0}).empty());
}

TEST_F(DriveNode, CanBeSomebodyElse) {
  boot();
  drive_.set_identity(2);
  EXPECT_EQ(read(0x1018, 2), 2U);
}

}  // namespace
}  // namespace liana::bench
