// The summary at the end of an MCAP file: what readers need to list channels and to jump to a time.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace liana::mcap {

// The messages of a chunk that is being filled.
struct OpenChunk {
  std::string records;
  std::uint64_t start_ns = 0, end_ns = 0;
  std::map<std::uint16_t, std::vector<std::pair<std::uint64_t, std::uint64_t>>> index;  // channel: time, offset

  // Appends a message record.
  void add(std::uint16_t channel, std::uint64_t time_ns, std::string_view message);
  // Content of its chunk record, compressed.
  std::string content() const;
};

class Summary {
 public:
  // Content of a record that is repeated in the summary.
  void note_schema(std::string_view content) { schemas_.emplace_back(content); }
  void note_channel(std::string_view content) { channels_.emplace_back(content); }
  void note_metadata(const std::string& name, std::uint64_t offset, std::uint64_t length);
  // A chunk that was written at `offset`, `length` bytes with its head; behind it its message indices.
  void note_chunk(const OpenChunk& chunk, std::uint64_t offset, std::uint64_t length, std::string_view content,
                  const std::map<std::uint16_t, std::uint64_t>& index_offsets, std::uint64_t index_length);
  // All records of the summary, for a file in which it starts at `start`, and the footer behind them.
  std::string bytes(std::uint64_t start) const;

 private:
  std::string statistics() const;

  std::vector<std::string> schemas_, channels_, metadata_, chunks_;
  std::map<std::uint16_t, std::uint64_t> message_counts_;
  std::uint64_t messages_ = 0, start_ns_ = 0, end_ns_ = 0;
};

}  // namespace liana::mcap
