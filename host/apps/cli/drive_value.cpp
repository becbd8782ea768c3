#include "host/apps/cli/drive_value.hpp"

#include <algorithm>
#include <charconv>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/drive_session.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {
namespace {

std::int64_t as_signed(const commissioning::Answer& answer) {
  const std::uint32_t value = answer.value();
  const std::size_t bits = 8 * std::min<std::size_t>(4, answer.bytes.size());
  if (bits == 0 || bits == 32) return static_cast<std::int32_t>(value);
  return (value >> (bits - 1)) != 0 ? static_cast<std::int64_t>(value) - (std::int64_t{1} << bits) : value;
}

std::string bytes_text(const std::vector<std::uint8_t>& bytes) {
  std::string text = "bytes";
  for (const std::uint8_t byte : bytes) text += " " + hex(byte, 2).substr(2);
  return text;
}

}  // namespace

std::optional<std::string> text_of(const std::vector<std::uint8_t>& bytes) {
  const auto end = std::find_if(bytes.rbegin(), bytes.rend(), [](std::uint8_t byte) { return byte != 0; }).base();
  const bool is_text = std::all_of(bytes.begin(), end, [](std::uint8_t byte) { return byte >= 0x20 && byte < 0x7F; });
  return is_text && bytes.size() > 4 ? std::optional(std::string(bytes.begin(), end)) : std::nullopt;
}

Json value_json(const commissioning::Answer& answer) {
  Json out = {{"bytes", answer.bytes}};
  if (answer.bytes.size() <= 4) {
    out["unsigned"] = answer.value();
    out["signed"] = as_signed(answer);
  } else if (const std::optional<std::string> text = text_of(answer.bytes)) {
    out["text"] = *text;
  }
  return out;
}

std::string value_text(const commissioning::Answer& answer) {
  if (const std::optional<std::string> text = text_of(answer.bytes)) return "\"" + *text + "\"";
  if (answer.bytes.size() > 4) return bytes_text(answer.bytes);
  const std::int64_t number = as_signed(answer);
  std::string text =
      hex(answer.value(), 2 * static_cast<int>(answer.bytes.size())) + "  " + std::to_string(answer.value());
  if (number < 0) text += "  " + std::to_string(number);
  return text + "  (" + std::to_string(8 * answer.bytes.size()) + " bits)";
}

std::int64_t value_of(const std::string& text, std::int64_t bits) {
  const std::int64_t most = (std::int64_t{1} << bits) - 1;
  if (!text.starts_with("0x") && !text.starts_with("0X"))
    return parse_whole("VALUE", text, -(most / 2) - 1, most, ", or hexadecimal as 0x1F");
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), value, 16);
  if (error != std::errc{} || end != text.data() + text.size() || value < 0 || value > most)
    throw launcher::BadInput("VALUE: '" + text + "': allowed: 0x0 to " + hex(static_cast<std::uint32_t>(most), 1) +
                             " for --bits " + std::to_string(bits));
  return value;
}

}  // namespace liana::cli
