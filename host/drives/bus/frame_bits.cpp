#include "host/drives/bus/frame_bits.hpp"

#include <array>
#include <cstddef>

namespace liana::bus {
namespace {

// How many equal bits the wire has seen last, and which; after five of them the sender inserts their complement, which
// counts as the first bit of the next run.
struct Stuffing {
  std::uint8_t run = 0;  // 0..4
  bool last = true;      // the idle bus is recessive

  // Returns the bits that `bit` takes on the wire.
  constexpr std::uint8_t put(bool bit) noexcept {
    run = static_cast<std::uint8_t>(bit == last ? run + 1 : 1);
    last = bit;
    if (run < 5) return 1;
    last = !bit;
    run = 1;
    return 2;
  }
};

constexpr std::uint32_t crc_after(std::uint32_t crc, bool bit) noexcept {
  const bool invert = bit != (((crc >> 14) & 1U) != 0);
  return ((crc << 1) & 0x7FFFU) ^ (invert ? 0x4599U : 0U);
}

struct StuffedByte {
  Stuffing after;
  std::uint8_t bits = 0;  // on the wire
};

constexpr std::size_t index_of(Stuffing state) noexcept { return 2U * state.run + (state.last ? 1U : 0U); }

// What eight bits do at once, for every state before them.
constexpr auto kStuffed = [] {
  std::array<std::array<StuffedByte, 256>, 10> table{};
  for (std::size_t state = 0; state < table.size(); ++state) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      StuffedByte& entry = table[state][byte];
      entry.after = {static_cast<std::uint8_t>(state / 2), state % 2 != 0};
      for (int i = 7; i >= 0; --i)
        entry.bits = static_cast<std::uint8_t>(entry.bits + entry.after.put(((byte >> i) & 1U) != 0));
    }
  }
  return table;
}();

constexpr auto kCrc = [] {
  std::array<std::uint16_t, 256> table{};
  for (std::size_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = 0;
    for (int i = 7; i >= 0; --i) crc = crc_after(crc, ((byte >> i) & 1U) != 0);
    table[byte] = static_cast<std::uint16_t>(crc);
  }
  return table;
}();

// Feeds the bits of a frame in wire order through CRC and bit stuffing.
class BitCounter {
 public:
  // The lowest `count` bits of `value`, most significant first.
  void put(std::uint32_t value, int count) noexcept {
    for (; count % 8 != 0; --count) {
      const bool bit = ((value >> (count - 1)) & 1U) != 0;
      crc_ = crc_after(crc_, bit);
      bits_ += stuffing_.put(bit);
    }
    for (; count > 0; count -= 8) {
      const std::uint32_t byte = (value >> (count - 8)) & 0xFFU;
      crc_ = ((crc_ << 8) & 0x7FFFU) ^ kCrc[((crc_ >> 7) ^ byte) & 0xFFU];
      stuff(byte);
    }
  }

  // The CRC sequence itself: stuffed, but not part of the CRC.
  void put_crc() noexcept {
    for (int i = 14; i >= 8; --i) bits_ += stuffing_.put(((crc_ >> i) & 1U) != 0);
    stuff(crc_ & 0xFFU);
  }

  std::uint32_t bits() const noexcept { return bits_; }
  std::uint16_t crc15() const noexcept { return static_cast<std::uint16_t>(crc_); }

 private:
  void stuff(std::uint32_t byte) noexcept {
    const StuffedByte& next = kStuffed[index_of(stuffing_)][byte];
    bits_ += next.bits;
    stuffing_ = next.after;
  }

  std::uint32_t crc_ = 0;
  std::uint32_t bits_ = 0;
  Stuffing stuffing_;
};

BitCounter count(const CanFrame& frame) noexcept {
  BitCounter counter;
  const bool remote = (frame.id & kCanRemoteFlag) != 0;
  counter.put(0, 1);  // start of frame
  if ((frame.id & kCanExtendedFlag) != 0) {
    const std::uint32_t id = frame.id & kCanExtendedMask;
    counter.put(id >> 18, 11);
    counter.put(3, 2);  // SRR, IDE
    counter.put(id & 0x3FFFFU, 18);
    counter.put(remote ? 1 : 0, 1);
    counter.put(0, 2);  // r1, r0
  } else {
    counter.put((frame.id & kCanStandardMask) << 3 | (remote ? 4U : 0U), 14);  // and RTR, IDE, r0
  }
  counter.put(frame.length, 4);
  for (std::size_t i = 0; !remote && i < frame.length && i < 8; ++i) counter.put(frame.data[i], 8);
  return counter;
}

}  // namespace

std::uint32_t frame_bits(const CanFrame& frame) noexcept {
  BitCounter counter = count(frame);
  counter.put_crc();
  return counter.bits() + kUnstuffedTailBits;
}

std::uint16_t frame_crc15(const CanFrame& frame) noexcept { return count(frame).crc15(); }

std::uint32_t arbitration_key(const CanFrame& frame) noexcept {
  const std::uint32_t remote = (frame.id & kCanRemoteFlag) != 0 ? 1U : 0U;
  if ((frame.id & kCanExtendedFlag) == 0) return ((frame.id & kCanStandardMask) << 21) | (remote << 20);
  const std::uint32_t id = frame.id & kCanExtendedMask;
  return ((id >> 18) << 21) | (3U << 19) | ((id & 0x3FFFFU) << 1) | remote;
}

}  // namespace liana::bus
