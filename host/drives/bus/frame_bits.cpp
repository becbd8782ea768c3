#include "host/drives/bus/frame_bits.hpp"

namespace liana::bus {
namespace {

// Feeds the bits of a frame in wire order through CRC and bit stuffing.
class BitCounter {
 public:
  // The lowest `count` bits of `value`, most significant first.
  void put(std::uint32_t value, int count) noexcept {
    for (int i = count - 1; i >= 0; --i) {
      const bool bit = ((value >> i) & 1U) != 0;
      crc(bit);
      stuff(bit);
    }
  }

  // The CRC sequence itself: stuffed, but not part of the CRC.
  void put_crc() noexcept {
    for (int i = 14; i >= 0; --i) stuff(((crc_ >> i) & 1U) != 0);
  }

  std::uint32_t bits() const noexcept { return bits_; }
  std::uint16_t crc15() const noexcept { return static_cast<std::uint16_t>(crc_); }

 private:
  void crc(bool bit) noexcept {
    const bool invert = bit != (((crc_ >> 14) & 1U) != 0);
    crc_ = (crc_ << 1) & 0x7FFFU;
    if (invert) crc_ ^= 0x4599U;
  }

  // After five equal bits the sender inserts their complement, which counts as the first bit of the next run.
  void stuff(bool bit) noexcept {
    ++bits_;
    run_ = bit == last_ ? run_ + 1 : 1;
    last_ = bit;
    if (run_ < 5) return;
    ++bits_;
    last_ = !bit;
    run_ = 1;
  }

  std::uint32_t crc_ = 0;
  std::uint32_t bits_ = 0;
  int run_ = 0;
  bool last_ = true;  // the idle bus is recessive
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
    counter.put(frame.id & kCanStandardMask, 11);
    counter.put(remote ? 1 : 0, 1);
    counter.put(0, 2);  // IDE, r0
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
