// A second of records as one blob.
#include "host/storage/archive/chunk.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace liana::archive {
namespace {

std::string records(std::size_t count, std::size_t bytes) {
  std::string out;
  for (std::size_t i = 0; i < count * bytes; ++i) out.push_back(static_cast<char>(i * i % 251));
  return out;
}

TEST(Chunk, GivesBackEveryByteOfEveryRecord) {
  for (const std::size_t count : {1u, 2u, 50u}) {
    const std::string plain = records(count, 568);
    EXPECT_EQ(unpacked(packed(plain, 568), count, 568), plain) << count;
  }
}

TEST(Chunk, IsSmallerWhereRecordsAreAlike) {
  std::string plain;
  for (int i = 0; i < 50; ++i) plain += std::string(568, 'x');
  EXPECT_LT(packed(plain, 568).size(), plain.size() / 50);
}

TEST(Chunk, IsSmallWhereNumbersGoOnSmoothly) {
  std::string plain;
  for (int row = 0; row < 50; ++row) {
    for (int i = 0; i < 142; ++i) {
      const float number = 10.0f + 0.01f * static_cast<float>(row * i);
      plain.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
  }
  EXPECT_LT(packed(plain, 568).size(), plain.size() / 3);
}

TEST(Chunk, RefusesABlobThatIsCutShort) {
  const std::string plain(50 * 568, 'x'), blob = packed(plain, 568);
  EXPECT_THROW(unpacked(blob.substr(0, blob.size() / 2), 50, 568), std::runtime_error);
}

}  // namespace
}  // namespace liana::archive
