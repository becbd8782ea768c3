#include "host/storage/recording/mcap_summary.hpp"

#include <algorithm>

#include "host/storage/recording/compression.hpp"
#include "host/storage/recording/mcap_format.hpp"

namespace liana::mcap {

namespace {

void put_counts(std::string& out, const std::map<std::uint16_t, std::uint64_t>& counts) {
  std::string entries;
  for (const auto& [channel, count] : counts) {
    put(entries, channel);
    put(entries, count);
  }
  put_text(out, entries);
}

}  // namespace

void OpenChunk::add(std::uint16_t channel, std::uint64_t time_ns, std::string_view message) {
  start_ns = records.empty() ? time_ns : std::min(start_ns, time_ns);
  end_ns = std::max(end_ns, time_ns);
  index[channel].emplace_back(time_ns, records.size());
  put_record(records, kMessage, message);
}

std::string OpenChunk::content() const {
  std::string out;
  put(out, start_ns);
  put(out, end_ns);
  put(out, static_cast<std::uint64_t>(records.size()));
  put(out, recording::crc_of(records));
  put_text(out, recording::compression_name());
  const std::string compressed = recording::compress(records);
  put(out, static_cast<std::uint64_t>(compressed.size()));
  return out + compressed;
}

void Summary::note_metadata(const std::string& name, std::uint64_t offset, std::uint64_t length) {
  std::string content;
  put(content, offset);
  put(content, length);
  put_text(content, name);
  metadata_.push_back(content);
}

void Summary::note_chunk(const OpenChunk& chunk, std::uint64_t offset, std::uint64_t length, std::string_view content,
                         const std::map<std::uint16_t, std::uint64_t>& index_offsets, std::uint64_t index_length) {
  constexpr std::size_t kFixedBytes = 8 + 8 + 8 + 4 + 4 + 8;  // of a chunk's content, around the compression's name
  const std::string name = recording::compression_name();
  std::string entry;
  put(entry, chunk.start_ns);
  put(entry, chunk.end_ns);
  put(entry, offset);
  put(entry, length);
  put_counts(entry, index_offsets);
  put(entry, index_length);
  put_text(entry, name);
  put(entry, static_cast<std::uint64_t>(content.size() - kFixedBytes - name.size()));
  put(entry, static_cast<std::uint64_t>(chunk.records.size()));
  chunks_.push_back(entry);
  start_ns_ = messages_ == 0 ? chunk.start_ns : std::min(start_ns_, chunk.start_ns);
  end_ns_ = std::max(end_ns_, chunk.end_ns);
  for (const auto& [channel, entries] : chunk.index) {
    message_counts_[channel] += entries.size();
    messages_ += entries.size();
  }
}

std::string Summary::statistics() const {
  std::string out;
  put(out, messages_);
  put(out, static_cast<std::uint16_t>(schemas_.size()));
  put(out, static_cast<std::uint32_t>(channels_.size()));
  put(out, std::uint32_t{0});  // attachments
  put(out, static_cast<std::uint32_t>(metadata_.size()));
  put(out, static_cast<std::uint32_t>(chunks_.size()));
  put(out, start_ns_);
  put(out, end_ns_);
  put_counts(out, message_counts_);
  return out;
}

std::string Summary::bytes(std::uint64_t start) const {
  std::string out, offsets;
  const auto group = [&](std::uint8_t opcode, const std::vector<std::string>& contents) {
    const std::uint64_t from = out.size();
    for (const std::string& content : contents) put_record(out, opcode, content);
    if (out.size() == from) return;
    std::string offset;
    put(offset, opcode);
    put(offset, start + from);
    put(offset, static_cast<std::uint64_t>(out.size() - from));
    put_record(offsets, kSummaryOffset, offset);
  };
  group(kSchema, schemas_);
  group(kChannel, channels_);
  group(kStatistics, {statistics()});
  group(kChunkIndex, chunks_);
  group(kMetadataIndex, metadata_);
  const std::uint64_t offsets_start = start + out.size();
  out += offsets;
  put(out, static_cast<std::uint8_t>(kFooter));
  put(out, static_cast<std::uint64_t>(kFooterBytes));
  put(out, start);
  put(out, offsets_start);
  put(out, recording::crc_of(out));
  return out;
}

}  // namespace liana::mcap
