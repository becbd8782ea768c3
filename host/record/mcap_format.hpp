// The numbers of the MCAP format that writer and reader share.
#pragma once

#include <cstdint>
#include <string_view>

namespace liana::mcap {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kMetadata = 0x0C,
  kDataEnd = 0x0F,
};

}  // namespace liana::mcap
