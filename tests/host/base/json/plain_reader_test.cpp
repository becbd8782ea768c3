// What is read without the library, and what is left to it; that both read alike is in same_as_library_test.cpp.
#include <gtest/gtest.h>

#include "host/base/json/plain_reader.hpp"

namespace liana {
namespace {

std::string read(std::string_view text, Json::Twice twice = Json::Twice::kLastCounts) {
  const std::optional<Json> value = read_plain(text, twice);
  return value ? value->dump() : "left to the library";
}

TEST(PlainReader, ReadsWhatProgramsWrite) {
  for (const char* text :
       {"null", "true", "false", "0", "18446744073709551615", "-9223372036854775808", "0.1", "-1.5e-07", "\"text\"",
        "[]", "{}", "[1,[2.5,\"a\"],{}]", R"({"a":{"b":[null,true]},"c":-3,"d":""})"}) {
    EXPECT_EQ(read(text), text);
  }
  EXPECT_EQ(read(" { \"a\" :\t[ 1 ,\n 2 ] }\r\n"), R"({"a":[1,2]})");
}

TEST(PlainReader, LeavesEverythingUnusualToTheLibrary) {
  for (const char* text : {"",      "[1,]",  "{\"a\":1,}", "01",           "1.",
                           ".5",    "-",     "+1",         "1e999",        "1e-999",
                           "nul",   "[1 2]", "1 2",        "[1",           "{\"a\" 1}",
                           "{1:1}", "\"a",   "\"\\n\"",    "\"\xc3\xa4\"", "\"\x7f\"",
                           "NaN",   "1e",    "[1}",        "// 1",         "18446744073709551616"}) {
    EXPECT_EQ(read(text), "left to the library") << text;
  }
}

TEST(PlainReader, MemberGivenTwiceCountsLastOrIsLeftToTheLibrary) {
  const char* text = R"({"a":{"x":1},"b":2,"a":[3]})";
  EXPECT_EQ(read(text), R"({"a":[3],"b":2})");
  EXPECT_EQ(read(text, Json::Twice::kRefuse), "left to the library");
  EXPECT_EQ(read(R"({"b":2,"a":{"b":1}})", Json::Twice::kRefuse), R"({"a":{"b":1},"b":2})");
}

TEST(PlainReader, LevelsBeyondTheDeepestAreLeftToTheLibrary) {
  const std::string open(Json::kMaxLevels, '['), close(Json::kMaxLevels, ']');
  EXPECT_EQ(read(open + close), open + close);
  EXPECT_EQ(read("[" + open + close + "]"), "left to the library");
}

}  // namespace
}  // namespace liana
