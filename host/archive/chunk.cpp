#include "host/archive/chunk.hpp"

#include "host/record/compression.hpp"

namespace liana::archive {

namespace {

constexpr int kLevel = 1;  // a second takes 0.1 ms; 3 gains 1 %

}  // namespace

std::string packed(std::string_view records, std::size_t record_bytes) {
  const std::size_t count = records.size() / record_bytes;
  std::string planes(records.size(), '\0');
  std::size_t at = 0;
  for (std::size_t byte = 0; byte < record_bytes; ++byte) {
    for (std::size_t row = 0; row < count; ++row) planes[at++] = records[row * record_bytes + byte];
  }
  std::string smaller = record::compress(planes, kLevel);
  return smaller.size() < planes.size() ? smaller : planes;
}

// A blob as long as its records is not compressed.
std::vector<std::string> unpacked(std::string_view blob, std::size_t count, std::size_t record_bytes) {
  const std::size_t size = count * record_bytes;
  const std::string planes = record::decompress(blob, blob.size() == size ? "" : "zstd", size);
  std::vector<std::string> records(count, std::string(record_bytes, '\0'));
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t byte = 0; byte < record_bytes; ++byte) records[row][byte] = planes[byte * count + row];
  }
  return records;
}

}  // namespace liana::archive
