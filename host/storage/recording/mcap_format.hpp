// The numbers of the MCAP format that writer and reader share, and how its fields are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/crc32.hpp"

namespace liana::mcap {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum Opcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

constexpr std::size_t kRecordHeadBytes = 9;  // operation code and length
constexpr std::size_t kFooterBytes = 20;     // summary start, summary offset start, summary CRC

template <recording::Scalar T>
void put(std::string& out, T value) {
  recording::Writer writer(out);
  writer("", value);
}

inline void put_text(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

inline void put_map(std::string& out, const std::map<std::string, std::string>& values) {
  std::string entries;
  for (const auto& [key, value] : values) {
    put_text(entries, key);
    put_text(entries, value);
  }
  put_text(out, entries);
}

inline void put_record(std::string& out, std::uint8_t opcode, std::string_view content) {
  put(out, opcode);
  put(out, static_cast<std::uint64_t>(content.size()));
  out += content;
}

}  // namespace liana::mcap
