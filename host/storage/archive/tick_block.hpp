// A second of ticks as two messages of the ring: Inputs with a checksum of the Outputs, and the Outputs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/storage/archive/packed_fields.hpp"
#include "host/storage/archive/rows.hpp"
#include "host/storage/recording/field_widths.hpp"

namespace liana::archive {

// What lianad says of one tick, as bytes of `liana-fields-2` (docs/reference/formats.md).
struct RingTick {
  std::uint64_t tick = 0;
  std::string inputs;
  std::uint32_t outputs_crc = 0;  // CRC-32 of the Outputs
  std::string outputs{};          // empty: they are not kept any more
};

// The tick that recorded Inputs or Outputs begin with.
std::uint64_t tick_of(std::string_view fields);

class TickBlock {
 public:
  explicit TickBlock(const recording::FieldWidths& widths);
  // Throws std::runtime_error when the bytes are not as many as the widths say.
  void add(std::string_view inputs, std::string_view outputs);
  bool is_empty() const { return count_ == 0; }
  std::uint32_t count() const { return count_; }
  std::uint64_t first_tick() const { return first_tick_; }
  std::uint64_t last_tick() const { return last_tick_; }
  // u64 first tick, u64 last tick, u32 ticks, u32 telecommands, u32 bytes of the Inputs, then packed(): Inputs without
  // telecommands and checksums of Outputs; behind it the telecommands, likewise.
  std::string inputs_message() const;
  // u64 first tick, u64 last tick, u32 ticks, packed() Outputs.
  std::string outputs_message() const;
  void clear();

 private:
  PackedFields inputs_words_, telecommand_words_, outputs_words_;
  std::string inputs_, telecommands_, outputs_;  // as words
  std::uint64_t first_tick_ = 0, last_tick_ = 0;
  std::uint32_t count_ = 0, telecommand_count_ = 0;
};

// The first and last tick of either message.
Span span_of_block(std::string_view message);

// All throw std::runtime_error when the message is damaged.
std::vector<RingTick> ticks_of(std::string_view inputs_message, const recording::FieldWidths& widths);
std::vector<std::string> outputs_of(std::string_view outputs_message, const recording::FieldWidths& widths);

}  // namespace liana::archive
