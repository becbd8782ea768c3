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

// Axes 1 and 2 of one node: what is said to the node is heard by both.
class TwoAxisNode : public DriveHarness {
 protected:
  TwoAxisNode() : DriveHarness(axis_settings(1)), second_(axis_settings(2), 2000.0) {
    boot();
    FrameList none;
    second_.tick(now_us_, none);
    EXPECT_TRUE(none.empty()) << "one boot-up message a node";
  }
  static DriveSettings axis_settings(int axis) {
    DriveSettings out = settings();
    out.axis = axis;
    out.axes = 2;
    return out;
  }
  FrameList give_node(std::uint32_t id, const std::vector<std::uint8_t>& bytes) {
    FrameList out = give(id, bytes);
    CanFrame frame;
    frame.time_us = now_us_;
    frame.id = id;
    frame.length = static_cast<std::uint8_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), frame.data.begin());
    second_.receive(frame, out);
    return out;
  }
  // The one answer to a request.
  std::vector<std::uint8_t> ask(std::vector<std::uint8_t> request) {
    request.resize(8);
    const FrameList out = give_node(0x600 + kNode, request);
    EXPECT_EQ(out.size(), 1U) << "one server a node";
    return out.empty() ? std::vector<std::uint8_t>{}
                       : std::vector<std::uint8_t>(out[0].data.begin(), out[0].data.end());
  }
  std::uint32_t tell(std::uint16_t index, std::uint8_t sub, std::size_t size, std::uint32_t value) {
    return aborted(ask(write_request(index, sub, size, value)));
  }
  std::uint32_t get(std::uint16_t index, std::uint8_t sub) {
    const std::vector<std::uint8_t> answer =
        ask({0x40, static_cast<std::uint8_t>(index), static_cast<std::uint8_t>(index >> 8), sub});
    EXPECT_EQ(get_little_endian(&answer[1], 2), index);
    EXPECT_EQ(answer[0] & 0xE3, 0x43) << std::hex << index;
    return static_cast<std::uint32_t>(get_little_endian(&answer[4], 4U - ((answer[0] >> 2U) & 3U)));
  }

  Drive second_;
};

TEST_F(TwoAxisNode, HasTheSecondOnesObjects0x800FurtherAndOneIdentity) {
  EXPECT_EQ(get(0x6064, 0), 1000U);
  EXPECT_EQ(get(0x6864, 0), 2000U);
  EXPECT_EQ(get(0x1018, 4), 70412U);
  EXPECT_EQ(aborted(ask({0x40, 0x64, 0x70, 0})), 0x06020000U) << "there is no third";
  EXPECT_EQ(tell(0x6865, 0, 4, 77), 0U);
  EXPECT_EQ(get(0x6865, 0), 77U);
  EXPECT_EQ(get(0x6065, 0), 20000U);
  EXPECT_EQ(ask({0x21, 0x7A, 0x68, 0, 4})[0], 0x60) << "in segments, which name no object";
  EXPECT_EQ(ask({0x00 | (3 << 1) | 1, 0x78, 0x56, 0x34, 0x12})[0], 0x20);
  EXPECT_EQ(get(0x687A, 0), 0x12345678U);
  EXPECT_NE(get(0x607A, 0), 0x12345678U);
}

TEST_F(TwoAxisNode, MapsTheSecondOnesProcessDataFromPdo65OnUnderAnyIdentifier) {
  EXPECT_EQ(get(0x1440, 1), 0x80000000U) << "none is predefined";
  EXPECT_EQ(tell(0x1440, 1, 4, 0x80000400U + kNode), 0U);
  EXPECT_EQ(tell(0x1640, 1, 4, 0x60400010), 0x06020000U) << "of the other axis";
  EXPECT_EQ(tell(0x1640, 1, 4, 0x68400010), 0U);
  EXPECT_EQ(tell(0x1640, 2, 4, 0x687A0020), 0U);
  EXPECT_EQ(tell(0x1640, 0, 1, 2), 0U);
  EXPECT_EQ(tell(0x1440, 1, 4, 0x400 + kNode), 0U);
  EXPECT_EQ(tell(0x1A40, 1, 4, 0x68640020), 0U);
  EXPECT_EQ(tell(0x1A40, 0, 1, 1), 0U);
  EXPECT_EQ(tell(0x1840, 1, 4, 0x80000380U + kNode), 0U);
  EXPECT_EQ(tell(0x1840, 1, 4, 0x380 + kNode), 0U);
  give_node(0x000, {0x01, kNode});
  give_node(0x400 + kNode, {0x06, 0, 0x39, 0x05, 0, 0});
  const auto report = find(give_node(0x080, {}), 0x380 + kNode);
  ASSERT_TRUE(report);
  EXPECT_EQ(get_little_endian(report->data.data(), 4), 2000U);
  EXPECT_EQ(get(0x687A, 0), 1337U);
  EXPECT_EQ(get(0x607A, 0), 1000U);
  EXPECT_EQ(get(0x6840, 0), 6U);
  EXPECT_EQ(get(0x6040, 0), 0U);
}

TEST_F(TwoAxisNode, BothAxesStopWhenTheMasterOfTheirNodeIsLost) {
  EXPECT_EQ(tell(0x1016, 1, 4, (127U << 16U) | 300U), 0U);
  give_node(0x000, {0x01, kNode});
  give_node(0x77F, {0x05});
  FrameList out = tick(400000);
  second_.tick(now_us_, out);
  EXPECT_EQ(drive_.nmt_state(), NmtState::kPreOperational);
  EXPECT_EQ(second_.nmt_state(), NmtState::kPreOperational);
}

}  // namespace
}  // namespace liana::bench
