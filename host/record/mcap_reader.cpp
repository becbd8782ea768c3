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

void visit_record(std::uint8_t opcode, std::string_view content, const McapVisitor& visitor, std::map<std::uint16_t, std::string>& topics) {
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

}  // namespace

bool read_mcap(const std::string& path, const McapVisitor& visitor) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) throw std::runtime_error("recording " + path + ": " + std::strerror(errno));
  std::string head(mcap::kMagic.size(), '\0');
  if (std::fread(head.data(), 1, head.size(), file.get()) != head.size() || head != mcap::kMagic) {
    throw std::runtime_error("recording " + path + ": not an MCAP file");
  }
  std::map<std::uint16_t, std::string> topics;
  std::string prefix(9, '\0'), content;
  while (std::fread(prefix.data(), 1, prefix.size(), file.get()) == prefix.size()) {
    Cursor cursor(prefix);
    const auto opcode = cursor.take<std::uint8_t>();
    const auto length = cursor.take<std::uint64_t>();
    if (length > kMaxRecordBytes)
      throw std::runtime_error("recording " + path + ": damaged (a record of " + std::to_string(length) + " bytes)");
    content.resize(length);
    if (std::fread(content.data(), 1, length, file.get()) != length) return false;
    if (opcode == mcap::kFooter) return true;
    visit_record(opcode, content, visitor, topics);
  }
  return false;
}

}  // namespace liana
