#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "host/record/codec.hpp"
#include "host/record/mcap.hpp"
#include "host/record/mcap_format.hpp"

namespace liana {

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

// A file record by record, with the checksum of what lies before each.
class RecordFile {
 public:
  explicit RecordFile(const std::string& path) : file_(std::fopen(path.c_str(), "rb"), &std::fclose), path_(path) {
    if (!file_) throw std::runtime_error("recording " + path + ": " + std::strerror(errno));
    if (read(mcap::kMagic.size()) != mcap::kMagic) throw std::runtime_error("recording " + path + ": not an MCAP file");
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

  std::string read(std::size_t count) {
    std::string bytes(count, '\0');
    bytes.resize(std::fread(bytes.data(), 1, count, file_.get()));
    crc_.add(bytes);
    return bytes;
  }

  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::string path_;
  Crc32 crc_;
  std::uint8_t opcode_ = 0;
  std::string content_;
  std::uint32_t before_ = 0;
};

// A checksum, all of `bytes`.
bool holds_crc(std::string_view bytes, std::uint32_t expected) {
  return bytes.size() == sizeof expected && Cursor(bytes).take<std::uint32_t>() == expected;
}

bool is_good_footer(std::string_view footer) {
  if (footer.size() != mcap::kFooterBytes) return false;
  const std::string_view before_crc = footer.substr(0, mcap::kFooterBytes - sizeof(std::uint32_t));
  return holds_crc(footer.substr(before_crc.size()), mcap::summary_crc(before_crc));
}

}  // namespace

McapState read_mcap(const std::string& path, const McapVisitor& visitor) {
  RecordFile file(path);
  std::map<std::uint16_t, std::string> topics;
  bool data_is_good = false;
  while (file.next()) {
    if (file.opcode() == mcap::kFooter) {
      const bool whole = data_is_good && is_good_footer(file.content()) && file.ends_well();
      return whole ? McapState::kWhole : McapState::kDamaged;
    }
    if (file.opcode() == mcap::kDataEnd) data_is_good = holds_crc(file.content(), file.crc_before());
    visit_record(file.opcode(), file.content(), visitor, topics);
  }
  return data_is_good ? McapState::kDamaged : McapState::kCutShort;
}

}  // namespace liana
