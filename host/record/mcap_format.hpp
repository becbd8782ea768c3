// The numbers of the MCAP format that writer and reader share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "host/record/crc32.hpp"

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

constexpr std::size_t kFooterBytes = 20;  // summary start, summary offset start, summary CRC

// The footer's own checksum: from the start of the summary (here empty: of the footer record) up to the checksum
// itself.
inline std::uint32_t summary_crc(std::string_view footer_before_crc) {
  std::string bytes{static_cast<char>(kFooter), static_cast<char>(kFooterBytes)};
  bytes.append(7, '\0');  // the rest of the record's 64-bit length
  bytes += footer_before_crc;
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace liana::mcap
