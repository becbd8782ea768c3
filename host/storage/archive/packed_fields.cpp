#include "host/storage/archive/packed_fields.hpp"

#include <cstring>
#include <stdexcept>

namespace liana::archive {
namespace {
constexpr std::size_t kFieldWord = 4;
}  // namespace

PackedFields::PackedFields(std::string_view widths) {
  std::size_t together = 0;
  for (const char digit : widths) {
    const auto width = static_cast<std::size_t>(digit - '0');
    const std::size_t padding = width < kFieldWord ? kFieldWord - width : 0;
    fields_bytes_ += width;
    words_bytes_ += width + padding;
    together += width;
    if (padding == 0) continue;
    runs_.push_back({together, padding});
    together = 0;
  }
  if (together > 0) runs_.push_back({together, 0});
}

void PackedFields::append_words(std::string& out, std::string_view fields) const {
  if (fields.size() != fields_bytes_) {
    throw std::runtime_error("tick of " + std::to_string(fields.size()) + " bytes, expected " +
                             std::to_string(fields_bytes_) + ": lianad and archive are of different versions");
  }
  std::size_t to = out.size();
  out.resize(to + words_bytes_);  // padding is zero
  const char* from = fields.data();
  for (const Run& run : runs_) {
    std::memcpy(out.data() + to, from, run.bytes);
    from += run.bytes;
    to += run.bytes + run.padding;
  }
}

std::string PackedFields::fields_of(std::string_view words) const {
  std::string fields(fields_bytes_, '\0');
  char* to = fields.data();
  const char* from = words.data();
  for (const Run& run : runs_) {
    std::memcpy(to, from, run.bytes);
    to += run.bytes;
    from += run.bytes + run.padding;
  }
  return fields;
}

}  // namespace liana::archive
