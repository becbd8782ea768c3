#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "host/storage/recording/mcap.hpp"
#include "host/storage/recording/mcap_format.hpp"

namespace liana::recording {

using namespace mcap;

namespace {

constexpr std::size_t kChunkBytes = 256u << 10;  // about 0.7 s at 250 Hz: what is lost when the process is killed

}  // namespace

McapWriter::McapWriter(const std::string& path, const std::string& library, const std::string& profile)
    : file_(std::fopen(path.c_str(), "wb")), path_(path) {
  if (!file_)
    throw std::runtime_error("recording " + path + ": " + std::strerror(errno) +
                             "; the folder must exist and be writable");
  write(kMagic);
  std::string content;
  put_text(content, profile);
  put_text(content, library);
  record(kHeader, content);
}

McapWriter::~McapWriter() = default;

// The reason of the first failure is what finish() says.
void McapWriter::note(bool good) {
  if (!good && failure_ == 0) failure_ = errno;
}

void McapWriter::write(std::string_view bytes) {
  crc_.add(bytes);
  written_ += bytes.size();
  note(std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size());
}

std::uint64_t McapWriter::record(std::uint8_t opcode, std::string_view content) {
  const std::uint64_t offset = written_;
  buffer_.clear();
  put_record(buffer_, opcode, content);
  write(buffer_);
  return offset;
}

std::uint16_t McapWriter::add_channel(const McapChannel& wanted) {
  const std::uint16_t id = ++channels_;
  std::string schema;
  put(schema, id);
  put_text(schema, wanted.schema_name.empty() ? wanted.topic : wanted.schema_name);
  put_text(schema, wanted.schema_encoding);
  put_text(schema, wanted.schema);
  record(kSchema, schema);
  summary_.note_schema(schema);
  std::string channel;
  put(channel, id);
  put(channel, id);
  put_text(channel, wanted.topic);
  put_text(channel, wanted.message_encoding);
  put_map(channel, wanted.metadata);
  record(kChannel, channel);
  summary_.note_channel(channel);
  return id;
}

void McapWriter::add_metadata(const std::string& name, const std::map<std::string, std::string>& values) {
  std::string content;
  put_text(content, name);
  put_map(content, values);
  const std::uint64_t offset = record(kMetadata, content);
  summary_.note_metadata(name, offset, written_ - offset);
}

void McapWriter::write_message(std::uint16_t channel, std::uint32_t sequence, std::uint64_t time_ns,
                               std::string_view data) {
  std::string content;
  content.reserve(data.size() + 22);
  put(content, channel);
  put(content, sequence);
  put(content, time_ns);
  put(content, time_ns);
  content += data;
  chunk_.add(channel, time_ns, content);
  if (chunk_.records.size() >= kChunkBytes) close_chunk();
}

// Writes what was gathered, and behind it where in it each channel's messages are.
void McapWriter::close_chunk() {
  if (chunk_.records.empty()) return;
  const std::string content = chunk_.content();
  const std::uint64_t offset = record(kChunk, content), length = written_ - offset;
  std::map<std::uint16_t, std::uint64_t> index_offsets;
  for (const auto& [channel, entries] : chunk_.index) {
    std::string index, pairs;
    for (const auto& [time_ns, at] : entries) {
      put(pairs, time_ns);
      put(pairs, at);
    }
    put(index, channel);
    put_text(index, pairs);
    index_offsets[channel] = record(kMessageIndex, index);
  }
  summary_.note_chunk(chunk_, offset, length, content, index_offsets, written_ - offset - length);
  chunk_ = OpenChunk{};
  note(std::fflush(file_.get()) == 0);
}

void McapWriter::finish() {
  close_chunk();
  std::string data_end;
  put(data_end, crc_.value());
  record(kDataEnd, data_end);
  write(summary_.bytes(written_));
  write(kMagic);
  note(std::fflush(file_.get()) == 0);
  if (failure_ != 0)
    throw std::runtime_error("recording " + path_ + ": cannot be written: " + std::strerror(failure_) +
                             "; the file is incomplete");
}

}  // namespace liana::recording
