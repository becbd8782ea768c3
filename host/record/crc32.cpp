#include "host/record/crc32.hpp"

#include <array>
#include <cstddef>

namespace liana::record {
namespace {

constexpr std::uint32_t kReflectedPolynomial = 0xEDB88320u;
constexpr std::size_t kLanes = 8;  // bytes taken at once

using Lanes = std::array<std::array<std::uint32_t, 256>, kLanes>;

// Table k holds what a byte does to the checksum when k more bytes follow it.
constexpr Lanes make_lanes() {
  Lanes lanes{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? kReflectedPolynomial : 0u);
    lanes[0][byte] = crc;
  }
  for (std::size_t k = 1; k < kLanes; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = lanes[k - 1][byte];
      lanes[k][byte] = (before >> 8) ^ lanes[0][before & 0xFFu];
    }
  }
  return lanes;
}

constexpr Lanes kByteEffect = make_lanes();

std::uint32_t byte_at(std::string_view bytes, std::size_t i) { return static_cast<std::uint8_t>(bytes[i]); }

}  // namespace

void Crc32::add(std::string_view bytes) noexcept {
  std::uint32_t crc = state_;
  while (bytes.size() >= kLanes) {
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < kLanes; ++i) {
      const std::uint32_t mixed = byte_at(bytes, i) ^ (i < 4 ? (crc >> (8 * i)) & 0xFFu : 0u);
      next ^= kByteEffect[kLanes - 1 - i][mixed];
    }
    crc = next;
    bytes.remove_prefix(kLanes);
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) crc = (crc >> 8) ^ kByteEffect[0][(crc ^ byte_at(bytes, i)) & 0xFFu];
  state_ = crc;
}

}  // namespace liana::record
