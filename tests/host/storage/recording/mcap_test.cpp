// The MCAP writer and reader.
#include "host/storage/recording/mcap.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

namespace liana::recording {
namespace {

std::string temporary(const std::string& name) {
  return testing::TempDir() + "liana_" + std::to_string(::getpid()) + name;
}

std::string write_small(const std::string& path, bool finish) {
  McapWriter file(path, "test");
  const std::uint16_t channel = file.add_channel({"inputs", "bytes", "text", "a schema"});
  file.add_metadata("run", {{"seed", "1"}, {"name", "x"}});
  file.write_message(channel, 7, 4000000, "hello");
  file.write_message(channel, 8, 8000000, std::string("\0z", 2));
  if (finish) file.finish();
  return path;
}

struct Seen {
  std::vector<std::string> messages;
  std::map<std::string, std::string> metadata;
  McapState state = McapState::kDamaged;
};

Seen read_all(const std::string& path) {
  Seen seen;
  McapVisitor visitor;
  visitor.message = [&](const std::string& topic, std::uint32_t sequence, std::uint64_t, std::string_view data) {
    seen.messages.push_back(topic + " " + std::to_string(sequence) + " " + std::string(data));
  };
  visitor.metadata = [&](const std::string&, const std::map<std::string, std::string>& values) {
    seen.metadata = values;
  };
  seen.state = read_mcap(path, visitor);
  return seen;
}

TEST(Mcap, WhatWasWrittenIsReadInOrder) {
  const Seen seen = read_all(write_small(temporary("a.mcap"), true));
  EXPECT_EQ(seen.state, McapState::kWhole);
  EXPECT_EQ(seen.messages, (std::vector<std::string>{"inputs 7 hello", std::string("inputs 8 \0z", 11)}));
  EXPECT_EQ(seen.metadata.at("seed"), "1");
}

TEST(Mcap, TheFileStartsAndEndsWithTheMagicOfTheFormat) {
  const std::string path = write_small(temporary("b.mcap"), true);
  std::ifstream in(path, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x89MCAP0\r\n"));
  EXPECT_EQ(bytes.substr(bytes.size() - 8), std::string("\x89MCAP0\r\n"));
  EXPECT_EQ(bytes[8], '\x01') << "the header record comes first";
}

TEST(Mcap, AFileCutShortIsReadUpToTheCut) {
  const std::string path = write_small(temporary("c.mcap"), true);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 60);
  const Seen seen = read_all(path);
  EXPECT_EQ(seen.state, McapState::kCutShort);
  EXPECT_FALSE(seen.messages.empty());
}

TEST(Mcap, TheChecksumIsTheOneOfTheStandards) {
  Crc32 crc;
  EXPECT_EQ(crc.value(), 0u);
  crc.add("1234");
  crc.add("56789");
  EXPECT_EQ(crc.value(), 0xCBF43926u) << "the check value of CRC-32/ISO-HDLC";
  crc.add("0123456789abcdef");
  Crc32 whole;
  whole.add("1234567890123456789abcdef");
  EXPECT_EQ(crc.value(), whole.value());
}

// Every byte and bit of a small file: records, checksums, end record, magic.
TEST(Mcap, NoFlippedBitAnywhereGoesUnnoticed) {
  const std::string path = write_small(temporary("e.mcap"), true);
  std::ifstream in(path, std::ios::binary);
  const std::string good((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << (bit % 8)));
    std::ofstream(path, std::ios::binary) << bad;
    try {
      EXPECT_NE(read_all(path).state, McapState::kWhole) << "bit " << bit;
    } catch (const std::runtime_error&) {
      // noticed, too
    }
  }
}

TEST(Mcap, OtherFilesAndMissingFilesAreRefused) {
  const std::string path = temporary("d.mcap");
  std::ofstream(path) << "this is no recording";
  EXPECT_THROW(read_all(path), std::runtime_error);
  EXPECT_THROW(read_all(temporary("none.mcap")), std::runtime_error);
  EXPECT_THROW(McapWriter("/nonexistent/folder/x.mcap", "test"), std::runtime_error);
}

}  // namespace
}  // namespace liana::recording
