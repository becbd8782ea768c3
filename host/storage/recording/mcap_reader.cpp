#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "host/base/file/in_file.hpp"
#include "host/storage/recording/codec.hpp"
#include "host/storage/recording/compression.hpp"
#include "host/storage/recording/mcap.hpp"
#include "host/storage/recording/mcap_format.hpp"

namespace liana::recording {

namespace {

constexpr std::uint64_t kMaxRecordBytes = 64u << 20;

// Reads fields of one record in order.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : bytes_(bytes), reader_(bytes) {}
  template <Scalar T>
  T take() {
    T value{};
    reader_("mcap record", value);
    return value;
  }
  std::string text() {
    const auto length = take<std::uint32_t>();
    std::string out;
    for (std::uint32_t i = 0; i < length; ++i) out.push_back(static_cast<char>(take<std::uint8_t>()));
    return out;
  }
  std::map<std::string, std::string> map() {
    std::map<std::string, std::string> out;
    const std::size_t end = take<std::uint32_t>() + reader_.position();
    while (reader_.position() < end) {
      const std::string key = text();
      out[key] = text();
    }
    return out;
  }
  std::string_view rest() const { return bytes_.substr(reader_.position()); }

 private:
  std::string_view bytes_;
  Reader reader_;
};

void visit_record(std::uint8_t opcode, std::string_view content, const McapVisitor& visitor,
                  std::map<std::uint16_t, std::string>& topics) {
  Cursor cursor(content);
  if (opcode == mcap::kChannel) {
    const auto id = cursor.take<std::uint16_t>();
    cursor.take<std::uint16_t>();
    topics[id] = cursor.text();
  } else if (opcode == mcap::kMetadata && visitor.metadata) {
    const std::string name = cursor.text();
    visitor.metadata(name, cursor.map());
  } else if (opcode == mcap::kMessage && visitor.message) {
    const auto channel = cursor.take<std::uint16_t>();
    const auto sequence = cursor.take<std::uint32_t>();
    const auto time_ns = cursor.take<std::uint64_t>();
    cursor.take<std::uint64_t>();
    visitor.message(topics[channel], sequence, time_ns, cursor.rest());
  }
}

// The records of a chunk, whose own checksum vouches for them even where the file was cut short behind it.
std::string chunk_records(std::string_view content, const std::string& path) {
  Cursor cursor(content);
  cursor.take<std::uint64_t>();
  cursor.take<std::uint64_t>();
  const auto size = cursor.take<std::uint64_t>();
  const auto crc = cursor.take<std::uint32_t>();
  const std::string compression = cursor.text();
  const auto length = cursor.take<std::uint64_t>();
  const std::string_view compressed = cursor.rest();
  const bool plausible = size <= kMaxRecordBytes && length == compressed.size();
  std::string records = plausible ? decompress(compressed, compression, size) : std::string();
  if (!plausible || crc_of(records) != crc)
    throw std::runtime_error("recording " + path +
                             ": damaged: a chunk does not match its checksum; take a good copy of the file");
  return records;
}

void visit_chunk(std::string_view records, const McapVisitor& visitor, std::map<std::uint16_t, std::string>& topics) {
  while (!records.empty()) {
    Cursor cursor(records);
    const auto opcode = cursor.take<std::uint8_t>();
    const auto length = cursor.take<std::uint64_t>();
    const std::string_view rest = cursor.rest();
    if (length > rest.size()) throw std::runtime_error("recording: damaged: a record ends behind its chunk");
    visit_record(opcode, rest.substr(0, length), visitor, topics);
    records = rest.substr(length);
  }
}

// A file record by record, with the checksum of what lies before each.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path) : file_(nullptr, &std::fclose), path_(path) {
    file::require_ordinary(path);
    file_.reset(std::fopen(path.c_str(), "rb"));
    if (!file_) throw std::runtime_error("recording " + path + ": " + std::strerror(errno));
    std::fseek(file_.get(), 0, SEEK_END);
    size_ = static_cast<std::uint64_t>(std::max(0L, std::ftell(file_.get())));
    std::rewind(file_.get());
    if (read(mcap::kMagic.size()) != mcap::kMagic)
      throw std::runtime_error("recording " + path + ": not an MCAP file: give a recording, such as ticks.mcap");
  }

  // The next record; false at the end of the file, or when it ends inside the record.
  bool next() {
    before_ = crc_.value();
    const std::string prefix = read(kPrefixBytes);
    if (prefix.size() != kPrefixBytes) return false;
    Cursor cursor(prefix);
    opcode_ = cursor.take<std::uint8_t>();
    const auto length = cursor.take<std::uint64_t>();
    if (length > kMaxRecordBytes)
      throw std::runtime_error("recording " + path_ + ": damaged (a record of " + std::to_string(length) + " bytes)");
    if (length > left()) return false;
    content_ = read(length);
    return content_.size() == length;
  }
  // Only the format's last bytes are left.
  bool ends_well() { return read(mcap::kMagic.size() + 1) == mcap::kMagic; }

  std::uint8_t opcode() const { return opcode_; }
  const std::string& content() const { return content_; }
  std::uint32_t crc_before() const { return before_; }

 private:
  static constexpr std::size_t kPrefixBytes = 9;

  std::uint64_t left() const { return size_ - read_; }

  std::string read(std::size_t count) {
    std::string bytes(count, '\0');
    bytes.resize(std::fread(bytes.data(), 1, count, file_.get()));
    crc_.add(bytes);
    read_ = std::min(size_, read_ + bytes.size());
    return bytes;
  }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::string path_;
  Crc32 crc_;
  std::uint64_t size_ = 0, read_ = 0;
  std::uint8_t opcode_ = 0;
  std::string content_;
  std::uint32_t before_ = 0;
};

// A checksum, all of `bytes`.
bool holds_crc(std::string_view bytes, std::uint32_t expected) {
  return bytes.size() == sizeof expected && Cursor(bytes).take<std::uint32_t>() == expected;
}

// The summary as far as it was read, and the footer behind it.
bool is_good_summary(std::string summary, std::string_view footer) {
  if (footer.size() != mcap::kFooterBytes) return false;
  const std::string_view before_crc = footer.substr(0, mcap::kFooterBytes - sizeof(std::uint32_t));
  mcap::put(summary, static_cast<std::uint8_t>(mcap::kFooter));
  mcap::put(summary, static_cast<std::uint64_t>(mcap::kFooterBytes));
  summary += before_crc;
  return holds_crc(footer.substr(before_crc.size()), crc_of(summary));
}

}  // namespace

McapState read_mcap(const std::string& path, const McapVisitor& visitor) {
  RecordFile file(path);
  std::map<std::uint16_t, std::string> topics;
  std::string summary;
  bool in_summary = false, data_is_good = false;
  while (file.next()) {
    if (file.opcode() == mcap::kFooter) {
      const bool whole = data_is_good && is_good_summary(summary, file.content()) && file.ends_well();
      return whole ? McapState::kWhole : McapState::kDamaged;
    }
    if (in_summary) {
      mcap::put_record(summary, file.opcode(), file.content());
    } else if (file.opcode() == mcap::kDataEnd) {
      in_summary = true;
      data_is_good = holds_crc(file.content(), file.crc_before());
    } else if (file.opcode() == mcap::kChunk) {
      visit_chunk(chunk_records(file.content(), path), visitor, topics);
    } else {
      visit_record(file.opcode(), file.content(), visitor, topics);
    }
  }
  return McapState::kCutShort;
}

}  // namespace liana::recording
