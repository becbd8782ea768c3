#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "host/record/codec.hpp"
#include "host/record/mcap.hpp"
#include "host/record/mcap_format.hpp"

namespace liana {

namespace {

template <Scalar T>
void put(std::string& out, T value) {
  Writer writer(out);
  writer("", value);
}

void put_text(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

void put_map(std::string& out, const std::map<std::string, std::string>& values) {
  std::string entries;
  for (const auto& [key, value] : values) {
    put_text(entries, key);
    put_text(entries, value);
  }
  put_text(out, entries);
}

}  // namespace

McapWriter::McapWriter(const std::string& path, const std::string& library)
    : file_(std::fopen(path.c_str(), "wb")), path_(path) {
  if (!file_)
    throw std::runtime_error("recording " + path + ": " + std::strerror(errno) +
                             "; the folder must exist and be writable");
  write(mcap::kMagic);
  std::string content;
  put_text(content, "liana");
  put_text(content, library);
  record(mcap::kHeader, content);
}

McapWriter::~McapWriter() = default;

void McapWriter::write(std::string_view bytes) {
  crc_.add(bytes);
  failed_ = std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size() || failed_;
}

void McapWriter::record(std::uint8_t opcode, std::string_view content) {
  buffer_.clear();
  put(buffer_, opcode);
  put(buffer_, static_cast<std::uint64_t>(content.size()));
  buffer_ += content;
  write(buffer_);
}

std::uint16_t McapWriter::add_channel(const std::string& topic, const std::string& encoding,
                                      const std::string& schema_text) {
  const std::uint16_t id = ++channels_;
  std::string schema;
  put(schema, id);
  put_text(schema, topic);
  put_text(schema, encoding);
  put_text(schema, schema_text);
  record(mcap::kSchema, schema);
  std::string channel;
  put(channel, id);
  put(channel, id);
  put_text(channel, topic);
  put_text(channel, encoding);
  put_map(channel, {});
  record(mcap::kChannel, channel);
  return id;
}

void McapWriter::add_metadata(const std::string& name, const std::map<std::string, std::string>& values) {
  std::string content;
  put_text(content, name);
  put_map(content, values);
  record(mcap::kMetadata, content);
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
  record(mcap::kMessage, content);
}

void McapWriter::finish() {
  std::string data_end, footer;
  put(data_end, crc_.value());
  record(mcap::kDataEnd, data_end);
  put(footer, std::uint64_t{0});  // no summary, no summary offsets
  put(footer, std::uint64_t{0});
  put(footer, mcap::summary_crc(footer));
  record(mcap::kFooter, footer);
  write(mcap::kMagic);
  failed_ = std::fflush(file_.get()) != 0 || failed_;
  if (failed_) throw std::runtime_error("recording " + path_ + ": a write failed (disk full?); the file is incomplete");
}

}  // namespace liana
