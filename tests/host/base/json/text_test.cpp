// Reading texts, also hostile ones.
#include <gtest/gtest.h>

#include "host/base/json/number_error.hpp"
#include "tests/message.hpp"

namespace liana {
namespace {

std::string parse_refusal(std::string_view text) {
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
  const std::string text = parse_refusal("{\n  \"a\": 1,\n  \"b\" x\n}");
  EXPECT_TRUE(names(text, {"line 3", "column 7", "':'"}));
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
    EXPECT_NE(parse_refusal(text), "") << text;
    EXPECT_TRUE(Json::parse_or_null(text).is_null()) << text;
  }
  EXPECT_NE(parse_refusal(std::string_view("1\0", 2)), "");
  EXPECT_NE(parse_refusal(std::string_view("1\0x", 3)), "");
  EXPECT_NE(parse_refusal(std::string_view("\"\0\"", 3)), "");
}

TEST(JsonText, NumberThatNoDoubleHoldsIsRefusedWithItsPlaceAndItself) {
  struct Row {
    std::string text, place_from_0, place_from_1, number;
  };
  const std::string long_number = std::string(400, '9') + ".5";
  const Row rows[] = {
      {"1e400", "", "", "1e400"},
      {"[-1e400]", "[0]", "[1]", "-1e400"},
      {R"({"a": 1E999})", "a", "a", "1E999"},
      {R"({"a":{"b":[1,{"c":2},[3,1e400]]}})", "a.b[2][1]", "a.b[3][2]", "1e400"},
      {R"([{"z":[]},{"z":[],"y":-1e400,"x":1}])", "[1].y", "[2].y", "-1e400"},
      {R"({"ä":[0,1e309]})", "\xc3\xa4[1]", "\xc3\xa4[2]", "1e309"},
      {"[" + long_number + "]", "[0]", "[1]", std::string(60, '9') + "..."},
  };
  for (const Row& row : rows) {
    try {
      (void)Json::parse(row.text);
      FAIL() << row.text << " was accepted";
    } catch (const JsonNumberError& error) {
      EXPECT_EQ(error.place(0), row.place_from_0);
      EXPECT_EQ(error.place(1), row.place_from_1);
      EXPECT_EQ(error.text, row.number);
      EXPECT_EQ(error.what(), (row.place_from_0.empty() ? "" : row.place_from_0 + ": ") + error.complaint());
      EXPECT_TRUE(error.complaint().starts_with(row.number + ": "));
      EXPECT_TRUE(names(error.complaint(), {"-1.797e308", "1.797e308"}));
    }
    EXPECT_TRUE(Json::parse_or_null(row.text).is_null());
  }
  for (const char* text : {"1e308", "-1.7976931348623157e308", "1e-400", "[18446744073709551616]"})
    EXPECT_FALSE(Json::parse(text).is_null()) << text;
}

TEST(JsonText, TextThatIsNoUtf8IsRefusedInBothDirections) {
  for (const char* bytes : {"\xff", "\x80", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"}) {
    EXPECT_NE(parse_refusal("\"" + std::string(bytes) + "\""), "") << bytes;
    EXPECT_THROW((void)Json(bytes).dump(), JsonError) << bytes;
    EXPECT_EQ(Json(std::string("a") + bytes).dump(-1, Json::BadUtf8::kReplace).substr(0, 5), "\"a\xef\xbf\xbd")
        << bytes;
  }
  EXPECT_EQ(Json::parse("\"\\u00e4\xc3\xb6\"").text(), "\xc3\xa4\xc3\xb6");
}

TEST(JsonText, NestingIsAcceptedUpToTheLimitAndAnErrorBeyond) {
  EXPECT_EQ(Json::parse(nested(Json::kMaxLevels, "[", "]")).dump().size(), 2u * Json::kMaxLevels);
  EXPECT_NE(parse_refusal(nested(Json::kMaxLevels + 1, "[", "]")).find("200 levels"), std::string::npos);
  EXPECT_NE(parse_refusal("{\"a\":" + nested(Json::kMaxLevels, "[", "]") + "}"), "");
  for (const int levels : {400'000, 3'000'000}) {
    EXPECT_NE(parse_refusal(nested(levels, "[", "")), "");
    EXPECT_NE(parse_refusal(nested(levels, "[", "]")), "");
    EXPECT_NE(parse_refusal(nested(levels, "{\"a\":", "}")), "");
    EXPECT_TRUE(Json::parse_or_null(nested(levels, "[", "]")).is_null());
  }
}

TEST(JsonText, LevelsThatAreClosedDoNotCount) {
  std::string text = "[";
  for (int i = 0; i < 10 * Json::kMaxLevels; ++i) text += "[{}],";
  EXPECT_EQ(Json::parse(text + "0]").size(), 10u * Json::kMaxLevels + 1);
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
