#include "host/storage/archive/chunk.hpp"

#include <bit>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "host/storage/recording/compression.hpp"

namespace liana::archive {

namespace {

constexpr int kLevel = 1;  // a second takes 0.2 ms; 3 gains 1 %
constexpr std::size_t kWord = sizeof(std::uint32_t);
constexpr std::uint8_t kMaxOrder = 2;  // of differences

using Words = std::vector<std::uint32_t>;

// Words of both signs as small numbers: 0, -1, 1, -2, ... are 0, 1, 2, 3, ...
std::uint32_t folded(std::uint32_t word) { return (word << 1) ^ ((word >> 31) != 0 ? ~0u : 0u); }
std::uint32_t unfolded(std::uint32_t number) { return (number >> 1) ^ ((number & 1u) != 0 ? ~0u : 0u); }

// From the word before, the first from 0.
Words differences(const Words& words) {
  Words out = words;
  for (std::size_t i = 1; i < words.size(); ++i) out[i] = words[i] - words[i - 1];
  return out;
}

void sum_up(Words& words) {
  for (std::size_t i = 1; i < words.size(); ++i) words[i] += words[i - 1];
}

std::size_t bits_of(const Words& words) {
  std::size_t bits = 0;
  for (const std::uint32_t word : words) bits += static_cast<std::size_t>(std::bit_width(folded(word)));
  return bits;
}

struct Column {
  Words words;
  std::uint8_t order = 0;
};

Column least(Words words) {
  Column best{words, 0};
  std::size_t min_bits = bits_of(words);
  for (std::uint8_t order = 1; order <= kMaxOrder; ++order) {
    words = differences(words);
    const std::size_t bits = bits_of(words);
    if (bits >= min_bits) continue;
    best = {words, order};
    min_bits = bits;
  }
  return best;
}

}  // namespace

std::string packed(std::string_view records, std::size_t record_bytes) {
  const std::size_t count = records.size() / record_bytes, places = record_bytes / kWord;
  std::string orders, planes;
  planes.reserve(places + records.size());
  for (std::size_t place = 0; place < places; ++place) {
    Words words(count);
    for (std::size_t row = 0; row < count; ++row)
      std::memcpy(&words[row], records.data() + row * record_bytes + place * kWord, kWord);
    const Column column = least(std::move(words));
    orders += static_cast<char>(column.order);
    for (unsigned shift = 0; shift < 32; shift += 8) {
      for (const std::uint32_t word : column.words) planes += static_cast<char>(folded(word) >> shift);
    }
  }
  planes.insert(0, orders);
  std::string smaller = recording::compress(planes, kLevel);
  return smaller.size() < planes.size() ? smaller : planes;
}

// A blob as long as what was packed is not compressed.
std::string unpacked(std::string_view blob, std::size_t count, std::size_t record_bytes) {
  const std::size_t places = record_bytes / kWord, size = places + count * record_bytes;
  const std::string all = recording::decompress(blob, blob.size() == size ? "" : "zstd", size);
  const std::string_view orders = std::string_view(all).substr(0, places),
                         planes = std::string_view(all).substr(places);
  std::string records(count * record_bytes, '\0');
  Words words(count);
  for (std::size_t place = 0; place < places; ++place) {
    const char* const plane = planes.data() + place * kWord * count;
    const auto byte = [&](std::size_t n, std::size_t row) {
      return std::uint32_t{static_cast<unsigned char>(plane[n * count + row])} << (8 * n);
    };
    for (std::size_t row = 0; row < count; ++row)
      words[row] = unfolded(byte(0, row) | byte(1, row) | byte(2, row) | byte(3, row));
    const auto order = static_cast<std::uint8_t>(orders[place]);
    if (order > kMaxOrder) throw std::runtime_error("a second of telemetry is damaged; take a good copy of the file");
    for (std::uint8_t i = 0; i < order; ++i) sum_up(words);
    for (std::size_t row = 0; row < count; ++row)
      std::memcpy(records.data() + row * record_bytes + place * kWord, &words[row], kWord);
  }
  return records;
}

}  // namespace liana::archive
