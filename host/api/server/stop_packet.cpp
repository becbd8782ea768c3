#include "host/api/server/stop_packet.hpp"

namespace liana::api {

namespace {

constexpr std::size_t kMaxRawReason = 1000;

// The first level of an object, member by member, as far as the bytes can be followed.
class Members {
 public:
  explicit Members(std::string_view packet) : rest_(packet) {}

  // Steps over the opening brace; false when there is none.
  bool open() {
    skip_blanks();
    return take('{');
  }
  // The next name and the raw text of its value; false when there is none that can be followed.
  bool next(std::string_view& name, std::string_view& value) {
    skip_blanks();
    take(',');
    skip_blanks();
    name = text();
    skip_blanks();
    if (!take(':')) return false;
    skip_blanks();
    value = this->value();
    return true;
  }

 private:
  bool take(char wanted) {
    if (rest_.empty() || rest_.front() != wanted) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void skip_blanks() {
    const std::size_t blanks = rest_.find_first_not_of(" \t\r\n");
    rest_.remove_prefix(blanks == std::string_view::npos ? rest_.size() : blanks);
  }
  std::string_view cut(std::size_t bytes) {
    const std::string_view front = rest_.substr(0, bytes);
    rest_.remove_prefix(front.size());
    return front;
  }
  // Bytes of the text that begins here, both quotes included; all that is left when it does not end.
  std::size_t text_bytes(std::size_t from) const {
    std::size_t i = from + 1;
    while (i < rest_.size() && rest_[i] != '"') i += rest_[i] == '\\' ? 2 : 1;
    return i + 1 - from;
  }
  // A text without its quotes; empty when none begins here.
  std::string_view text() {
    if (rest_.empty() || rest_.front() != '"') return {};
    std::string_view quoted = cut(text_bytes(0));
    quoted.remove_prefix(1);
    if (quoted.ends_with('"')) quoted.remove_suffix(1);
    return quoted;
  }
  std::string_view value() {
    if (!rest_.empty() && rest_.front() == '"') return text();
    std::size_t i = 0, level = 0;
    for (; i < rest_.size(); ++i) {
      const char c = rest_[i];
      if (level == 0 && (c == ',' || c == '}')) break;
      if (c == '"') {
        i += text_bytes(i) - 1;
      } else if (c == '{' || c == '[') {
        ++level;
      } else if ((c == '}' || c == ']') && level > 0) {
        --level;
      }
    }
    return cut(i);
  }

  std::string_view rest_;
};

}  // namespace

StopPacket read_stop(std::string_view packet) {
  StopPacket found;
  Members members(packet);
  if (!members.open()) return found;
  for (std::string_view name, value; members.next(name, value);) {
    if (name == "op" && value == "stop") found.is_stop = true;
    if (name == "reason") found.reason = value.substr(0, kMaxRawReason);
  }
  return found;
}

}  // namespace liana::api
