#include "host/storage/archive/chunk.hpp"

#include <array>
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
void subtract_before(const Words& words, Words& out) {
  out = words;
  for (std::size_t i = 1; i < words.size(); ++i) out[i] = words[i] - words[i - 1];
}

void sum_up(Words& words) {
  for (std::size_t i = 1; i < words.size(); ++i) words[i] += words[i - 1];
}

std::size_t bits_of(const Words& words) {
  std::size_t bits = 0;
  for (const std::uint32_t word : words) bits += static_cast<std::size_t>(std::bit_width(folded(word)));
  return bits;
}

// A column of words and its differences, order by order; kept from one column to the next.
using Orders = std::array<Words, kMaxOrder + 1>;

// The order whose words are the smallest.
std::uint8_t least_order(Orders& orders) {
  std::uint8_t best = 0;
  std::size_t min_bits = bits_of(orders[0]);
  for (std::uint8_t order = 1; order <= kMaxOrder; ++order) {
    subtract_before(orders[order - 1u], orders[order]);
    const std::size_t bits = bits_of(orders[order]);
    if (bits >= min_bits) continue;
    best = order;
    min_bits = bits;
  }
  return best;
}

}  // namespace

std::string packed(std::string_view records, std::size_t record_bytes) {
  const std::size_t count = records.size() / record_bytes, places = record_bytes / kWord;
  std::string planes(places + count * places * kWord, '\0');
  Orders orders;
  orders[0].resize(count);
  char* plane = planes.data() + places;
  for (std::size_t place = 0; place < places; ++place) {
    for (std::size_t row = 0; row < count; ++row)
      std::memcpy(&orders[0][row], records.data() + row * record_bytes + place * kWord, kWord);
    const std::uint8_t order = least_order(orders);
    planes[place] = static_cast<char>(order);
    for (std::size_t row = 0; row < count; ++row) {
      const std::uint32_t word = folded(orders[order][row]);
      for (std::size_t n = 0; n < kWord; ++n) plane[n * count + row] = static_cast<char>(word >> (8 * n));
    }
    plane += kWord * count;
  }
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
