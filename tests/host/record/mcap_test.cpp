// The MCAP writer and reader.
#include "host/record/mcap.hpp"

#include <gtest/gtest.h>

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <vector>

namespace liana {
namespace {

std::string temporary(const std::string& name) { return testing::TempDir() + "liana_" + std::to_string(::getpid()) + name; }

std::string write_small(const std::string& path, bool finish) {
  McapWriter file(path, "test");
  const std::uint16_t channel = file.add_channel("inputs", "bytes", "a schema");
  file.add_metadata("run", {{"seed", "1"}, {"name", "x"}});
  file.write_message(channel, 7, 4000000, "hello");
  file.write_message(channel, 8, 8000000, std::string("\0z", 2));
  if (finish) file.finish();
  return path;
}

struct Seen {
  std::vector<std::string> messages;
  std::map<std::string, std::string> metadata;
  bool complete = false;
};

Seen read_all(const std::string& path) {
  Seen seen;
  McapVisitor visitor;
  visitor.message = [&](const std::string& topic, std::uint32_t sequence, std::uint64_t, std::string_view data) {
    seen.messages.push_back(topic + " " + std::to_string(sequence) + " " + std::string(data));
  };
  visitor.metadata = [&](const std::string&, const std::map<std::string, std::string>& values) { seen.metadata = values; };
  seen.complete = read_mcap(path, visitor);
  return seen;
}

TEST(Mcap, WhatWasWrittenIsReadInOrder) {
  const Seen seen = read_all(write_small(temporary("a.mcap"), true));
  EXPECT_TRUE(seen.complete);
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
  EXPECT_FALSE(seen.complete);
  EXPECT_FALSE(seen.messages.empty());
}

TEST(Mcap, OtherFilesAndMissingFilesAreRefused) {
  const std::string path = temporary("d.mcap");
  std::ofstream(path) << "this is no recording";
  EXPECT_THROW(read_all(path), std::runtime_error);
  EXPECT_THROW(read_all(temporary("none.mcap")), std::runtime_error);
  EXPECT_THROW(McapWriter("/nonexistent/folder/x.mcap", "test"), std::runtime_error);
}

}  // namespace
}  // namespace liana
