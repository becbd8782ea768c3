// Recorded bytes of a tick as 32-bit words, a field each (two for 8 bytes), which packed() takes; and back.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace liana::archive {

// How the bytes of one record lie in fields and in words; made once for many records.
class PackedFields {
 public:
  // `widths`: a digit for each field (host/storage/recording/field_widths.hpp).
  explicit PackedFields(std::string_view widths);

  std::size_t bytes_of_fields() const { return fields_bytes_; }
  std::size_t bytes_of_words() const { return words_bytes_; }
  // Appends the words. Throws std::runtime_error when `fields` are not as many bytes as the widths say.
  void append_words(std::string& out, std::string_view fields) const;
  // The bytes again, from bytes_of_words() that append_words() made.
  std::string fields_of(std::string_view words) const;

 private:
  // Fields that stand together in both, then bytes that only words have.
  struct Run {
    std::size_t bytes, padding;
  };
  std::vector<Run> runs_;
  std::size_t fields_bytes_ = 0, words_bytes_ = 0;
};

}  // namespace liana::archive
