// Reading texts, also hostile ones.
#include <gtest/gtest.h>

#include "host/json/json.hpp"

namespace liana {
namespace {

std::string refusal_of(std::string_view text) {
  try {
    (void)Json::parse(text);
  } catch (const JsonParseError& error) {
    return error.what();
  }
  return "";
}

std::string nested(int levels, const char* open, const char* close) {
  std::string text;
  for (int i = 0; i < levels; ++i) text += open;
  for (int i = 0; i < levels; ++i) text += close;
  return text;
}

TEST(JsonText, SyntaxErrorNamesLineColumnAndWhatWasExpected) {
  const std::string text = refusal_of("{\n  \"a\": 1,\n  \"b\" x\n}");
  EXPECT_TRUE(text.starts_with("parse error at line 3, column 7: ")) << text;
  EXPECT_NE(text.find("expected ':'"), std::string::npos) << text;
  try {
    (void)Json::parse("[1,2");
    FAIL() << "half an array was accepted";
  } catch (const JsonParseError& error) {
    EXPECT_EQ(error.byte, 5u);
  }
}

TEST(JsonText, WhatIsNoJsonIsRefused) {
  for (const char* text :
       {"",         " ",       "nul",         "tru", "{",     "[1,]",    "{\"a\":1,}", "[1 2]",
        "1 2",      "{a:1}",   "'a'",         "01",  "+1",    ".5",      "1.",         "NaN",
        "Infinity", "\"\\x\"", "\"\\ud800\"", "\"a", "1e999", "// a\n1", "[1]]",       "\xef\xbb\xbf"}) {
    EXPECT_NE(refusal_of(text), "") << text;
    EXPECT_TRUE(Json::parse_or_null(text).is_null()) << text;
  }
  EXPECT_NE(refusal_of(std::string_view("1\0", 2)), "");
  EXPECT_NE(refusal_of(std::string_view("1\0x", 3)), "");
  EXPECT_NE(refusal_of(std::string_view("\"\0\"", 3)), "");
}

TEST(JsonText, TextThatIsNoUtf8IsRefusedInBothDirections) {
  for (const char* bytes : {"\xff", "\x80", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"}) {
    EXPECT_NE(refusal_of("\"" + std::string(bytes) + "\""), "") << bytes;
    EXPECT_THROW((void)Json(bytes).dump(), JsonError) << bytes;
    EXPECT_EQ(Json(std::string("a") + bytes).dump(-1, Json::BadUtf8::kReplace).substr(0, 5), "\"a\xef\xbf\xbd")
        << bytes;
  }
  EXPECT_EQ(Json::parse("\"\\u00e4\xc3\xb6\"").text(), "\xc3\xa4\xc3\xb6");
}

TEST(JsonText, NestingIsAcceptedUpToTheLimitAndAnErrorBeyond) {
  EXPECT_EQ(Json::parse(nested(Json::kMostLevels, "[", "]")).dump().size(), 2u * Json::kMostLevels);
  EXPECT_NE(refusal_of(nested(Json::kMostLevels + 1, "[", "]")).find("200 levels"), std::string::npos);
  EXPECT_NE(refusal_of("{\"a\":" + nested(Json::kMostLevels, "[", "]") + "}"), "");
  for (const int levels : {400'000, 3'000'000}) {
    EXPECT_NE(refusal_of(nested(levels, "[", "")), "");
    EXPECT_NE(refusal_of(nested(levels, "[", "]")), "");
    EXPECT_NE(refusal_of(nested(levels, "{\"a\":", "}")), "");
    EXPECT_TRUE(Json::parse_or_null(nested(levels, "[", "]")).is_null());
  }
}

TEST(JsonText, LevelsThatAreClosedDoNotCount) {
  std::string text = "[";
  for (int i = 0; i < 10 * Json::kMostLevels; ++i) text += "[{}],";
  EXPECT_EQ(Json::parse(text + "0]").size(), 10u * Json::kMostLevels + 1);
}

TEST(JsonText, MemberGivenTwiceCountsLastOrIsRefusedByName) {
  const char* text = R"({"a":{"x":1},"b":{"x":2,"x":3}})";
  EXPECT_EQ(Json::parse(text)["b"]["x"], 3);
  EXPECT_EQ(Json::parse(R"({"a":1,"b":{"a":1}})", Json::Twice::kRefuse)["b"]["a"], 1);
  try {
    (void)Json::parse(text, Json::Twice::kRefuse);
    FAIL() << "x was given twice";
  } catch (const JsonTwiceError& error) {
    EXPECT_EQ(error.key, "x");
  }
}

TEST(JsonText, MillionMembersInAnyOrderAreReadInLinearithmicTime) {
  std::string text = "{";
  for (int i = 1'000'000; i > 0; --i) text += "\"" + std::to_string(i) + "\":0,";
  EXPECT_EQ(Json::parse(text + "\"last\":0}").size(), 1'000'001u);
}

TEST(JsonText, IndentedTextHasOneEntryPerLine) {
  EXPECT_EQ(Json::parse(R"({"a":[1,{}],"b":[],"c":{"d":null}})").dump(1),
            "{\n \"a\": [\n  1,\n  {}\n ],\n \"b\": [],\n \"c\": {\n  \"d\": null\n }\n}");
}

}  // namespace
}  // namespace liana
