// The checksum of MCAP files: CRC-32 as in IEEE 802.3 (polynomial 0x04C11DB7, reflected, start and end inverted).
#pragma once

#include <cstdint>
#include <string_view>

namespace liana::recording {

// Takes bytes in any number of pieces; O(bytes).
class Crc32 {
 public:
  void add(std::string_view bytes) noexcept;
  // Of everything added so far; 0 when that is nothing.
  std::uint32_t value() const noexcept { return value_; }

 private:
  std::uint32_t value_ = 0;
};

// Of bytes that are all there.
inline std::uint32_t crc_of(std::string_view bytes) noexcept {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace liana::recording
