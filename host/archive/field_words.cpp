#include "host/archive/field_words.hpp"

#include <algorithm>
#include <stdexcept>

namespace liana::archive {
namespace {

constexpr std::size_t kWord = 4;

std::size_t width_of(char digit) { return static_cast<std::size_t>(digit - '0'); }
std::size_t padded(std::size_t width) { return std::max(width, kWord); }

}  // namespace

std::size_t bytes_of_fields(std::string_view widths) {
  std::size_t bytes = 0;
  for (const char digit : widths) bytes += width_of(digit);
  return bytes;
}

std::size_t bytes_of_words(std::string_view widths) {
  std::size_t bytes = 0;
  for (const char digit : widths) bytes += padded(width_of(digit));
  return bytes;
}

void append_words(std::string& out, std::string_view fields, std::string_view widths) {
  if (fields.size() != bytes_of_fields(widths)) {
    throw std::runtime_error("tick of " + std::to_string(fields.size()) + " bytes, expected " +
                             std::to_string(bytes_of_fields(widths)) +
                             ": lianad and archive are of different versions");
  }
  std::size_t at = 0;
  for (const char digit : widths) {
    const std::size_t width = width_of(digit);
    out += fields.substr(at, width);
    out.append(padded(width) - width, '\0');
    at += width;
  }
}

std::string fields_of(std::string_view words, std::string_view widths) {
  std::string fields;
  std::size_t at = 0;
  for (const char digit : widths) {
    fields += words.substr(at, width_of(digit));
    at += padded(width_of(digit));
  }
  return fields;
}

}  // namespace liana::archive
