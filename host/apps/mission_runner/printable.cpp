#include "host/apps/mission_runner/printable.hpp"

namespace liana::mission_runner {

namespace {

bool is_control(unsigned char c) { return (c < 0x20 && c != '\t' && c != '\n') || c == 0x7F; }

// Whether the two bytes are one of the control characters from U+0080 to U+009F.
bool is_second_control(unsigned char first, unsigned char second) {
  return first == 0xC2 && second >= 0x80 && second < 0xA0;
}

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto first = static_cast<unsigned char>(text[i]);
    const auto second = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    const bool is_pair = is_second_control(first, second);
    out += is_pair || is_control(first) ? '?' : text[i];
    if (is_pair) ++i;
  }
  return out;
}

}  // namespace liana::mission_runner
