#include "host/archive/field_words.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace liana::archive {
namespace {

constexpr std::size_t kWord = 4;

// Calls copy(bytes) for fields that are whole words, as many as stand together, and narrow(bytes) for one that is not.
template <class Copy, class Narrow>
void for_each_run(std::string_view widths, const Copy& copy, const Narrow& narrow) {
  std::size_t run = 0;
  for (const char digit : widths) {
    const auto width = static_cast<std::size_t>(digit - '0');
    if (width >= kWord) {
      run += width;
      continue;
    }
    copy(std::exchange(run, 0));
    narrow(width);
  }
  copy(run);
}

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
  const auto take = [&](std::size_t bytes) {
    out += fields.substr(0, bytes);
    fields.remove_prefix(bytes);
  };
  for_each_run(widths, take, [&](std::size_t width) {
    take(width);
    out.append(kWord - width, '\0');
  });
}

std::string fields_of(std::string_view words, std::string_view widths) {
  std::string fields;
  fields.reserve(words.size());
  const auto take = [&](std::size_t bytes) {
    fields += words.substr(0, bytes);
    words.remove_prefix(bytes);
  };
  for_each_run(widths, take, [&](std::size_t width) {
    take(width);
    words.remove_prefix(kWord - width);
  });
  return fields;
}

}  // namespace liana::archive
