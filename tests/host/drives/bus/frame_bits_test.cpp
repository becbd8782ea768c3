// Lengths on the wire against a second implementation that works on strings of bits, and against figures known from
// elsewhere.
#include "host/drives/bus/frame_bits.hpp"

#include <gtest/gtest.h>

#include <bitset>
#include <random>
#include <string>

namespace liana::bus {
namespace {

template <std::size_t kBits>
std::string bits_of(std::uint64_t value) {
  return std::bitset<kBits>(value).to_string();
}

// Polynomial division on a string, the textbook's way.
std::string crc_by_division(const std::string& message) {
  const std::string polynomial = "1100010110011001";  // x^15 + 0x4599
  std::string rest = message + std::string(15, '0');
  for (std::size_t i = 0; i < message.size(); ++i) {
    if (rest[i] == '0') continue;
    for (std::size_t k = 0; k < polynomial.size(); ++k) rest[i + k] = rest[i + k] == polynomial[k] ? '0' : '1';
  }
  return rest.substr(message.size());
}

std::string stuffed(const std::string& bits) {
  std::string out;
  for (const char bit : bits) {
    out += bit;
    const bool five_equal = out.size() >= 5 && out.substr(out.size() - 5) == std::string(5, bit);
    if (five_equal) out += bit == '0' ? '1' : '0';
  }
  return out;
}

std::string unstuffed_bits(const CanFrame& frame) {
  const bool extended = (frame.id & kCanExtendedFlag) != 0;
  const bool remote = (frame.id & kCanRemoteFlag) != 0;
  const std::uint32_t id = frame.id & kCanExtendedMask;
  std::string bits = "0";
  if (extended) {
    bits += bits_of<11>(id >> 18) + "11" + bits_of<18>(id & 0x3FFFF) + (remote ? "1" : "0") + "00";
  } else {
    bits += bits_of<11>(id) + (remote ? "1" : "0") + "00";
  }
  bits += bits_of<4>(frame.length);
  for (std::size_t i = 0; !remote && i < frame.length; ++i) bits += bits_of<8>(frame.data[i]);
  return bits;
}

std::size_t reference_bits(const CanFrame& frame) {
  const std::string bits = unstuffed_bits(frame);
  return stuffed(bits + crc_by_division(bits)).size() + kUnstuffedTailBits;
}

CanFrame random_frame(std::mt19937& random) {
  CanFrame frame;
  const bool extended = random() % 4 == 0;
  frame.id = extended ? (random() & kCanExtendedMask) | kCanExtendedFlag : random() & kCanStandardMask;
  if (random() % 16 == 0) frame.id |= kCanRemoteFlag;
  frame.length = static_cast<std::uint8_t>(random() % 9);
  const auto pattern = random() % 3;  // plain zeros and ones have the most stuff bits
  for (auto& byte : frame.data) byte = static_cast<std::uint8_t>(pattern == 0 ? 0 : pattern == 1 ? 0xFF : random());
  return frame;
}

TEST(FrameBits, TheReferenceCrcHasTheCatalogueCheckValueOfCrc15Can) {
  std::string bits;
  for (const char letter : std::string("123456789")) bits += bits_of<8>(static_cast<std::uint64_t>(letter));
  EXPECT_EQ(std::bitset<15>(crc_by_division(bits)).to_ulong(), 0x059EU);
}

TEST(FrameBits, CrcAndLengthAgreeWithBitStringsOverRandomFrames) {
  std::mt19937 random(1);
  for (int i = 0; i < 5000; ++i) {
    const CanFrame frame = random_frame(random);
    ASSERT_EQ(frame_crc15(frame), std::bitset<15>(crc_by_division(unstuffed_bits(frame))).to_ulong())
        << std::hex << frame.id;
    ASSERT_EQ(frame_bits(frame), reference_bits(frame)) << std::hex << frame.id << " length " << int{frame.length};
  }
}

TEST(FrameBits, AnAllZeroFrameIsStuffedAfterEveryFiveBits) {
  // 34 dominant bits up to the end of the CRC: six stuff bits, and 13 that are never stuffed.
  EXPECT_EQ(frame_bits(CanFrame{}), 34U + 6U + 13U);
}

TEST(FrameBits, LengthsStayBetweenTheUnstuffedAndTheWorstCase) {
  std::mt19937 random(2);
  for (int i = 0; i < 5000; ++i) {
    CanFrame frame = random_frame(random);
    frame.id &= ~kCanRemoteFlag;
    const bool extended = (frame.id & kCanExtendedFlag) != 0;
    EXPECT_GE(frame_bits(frame), (extended ? 67U : 47U) + 8U * frame.length);
    EXPECT_LE(frame_bits(frame), (extended ? 80U : 55U) + 10U * frame.length);
  }
}

TEST(Arbitration, TheLowerIdentifierWinsAndStandardBeatsExtendedWithTheSameBase) {
  const auto key = [](std::uint32_t id) { return arbitration_key(CanFrame{id, 0, {}, 0}); };
  EXPECT_LT(key(0x080), key(0x181));
  EXPECT_LT(key(0x181), key(0x182));
  EXPECT_LT(key(0x181), key(0x181 | kCanRemoteFlag));
  EXPECT_LT(key(0x181), key((0x181U << 18) | kCanExtendedFlag));
  EXPECT_LT(key(0x181 | kCanRemoteFlag), key((0x181U << 18) | kCanExtendedFlag));
  EXPECT_LT(key((0x181U << 18) | kCanExtendedFlag), key(0x182));
  EXPECT_LT(key((0x181U << 18) | 5U | kCanExtendedFlag), key((0x181U << 18) | 6U | kCanExtendedFlag));
}

}  // namespace
}  // namespace liana::bus
