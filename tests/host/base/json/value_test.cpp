// Building, reading and changing a value.
#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "host/base/json/json.hpp"
#include "tests/message.hpp"

namespace liana {
namespace {

std::string refusal_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const JsonError& error) {
    return error.what();
  }
  return "";
}

TEST(JsonValue, BracedListOfNamedPairsIsAnObjectAndAnyOtherAnArray) {
  EXPECT_EQ((Json{{"b", 1}, {"a", {{"c", {}}}}}).dump(), R"({"a":{"c":null},"b":1})");
  EXPECT_EQ((Json{{"a", 1}, {2, 3}}).dump(), R"([["a",1],[2,3]])");
  EXPECT_EQ((Json{1, 2.5, "x", true, nullptr}).dump(), R"([1,2.5,"x",true,null])");
  EXPECT_EQ(Json::array({"a", 1}).dump(), R"(["a",1])");
  EXPECT_EQ(Json::array({{"a", 1}}).dump(), R"([["a",1]])");
  EXPECT_EQ(Json::object({{"a", 1}}).dump(), R"({"a":1})");
  EXPECT_NE(refusal_of([] { Json::object({{"a", 1}, {2, 3}}); }), "");
}

TEST(JsonValue, ListsAndMapsOfTheStandardLibraryBecomeArraysAndObjects) {
  EXPECT_EQ(Json(std::vector<double>{1, 2.5}).dump(), "[1.0,2.5]");
  EXPECT_EQ(Json(std::deque<std::string>{"a", "b"}).dump(), R"(["a","b"])");
  EXPECT_EQ(Json(std::array<std::array<int, 2>, 2>{{{1, 2}, {3, 4}}}).dump(), "[[1,2],[3,4]]");
  EXPECT_EQ(Json(std::map<std::string, int>{{"b", 1}, {"a", 2}}).dump(), R"({"a":2,"b":1})");
}

TEST(JsonValue, EntriesOfABracedListAreMovedNotCopied) {
  std::string text(1000, 'x');
  const char* bytes = text.data();
  const Json value{{"text", std::move(text)}};
  EXPECT_EQ(value["text"].text().data(), bytes);
}

TEST(JsonValue, GivesWhatWasPutIn) {
  const Json value{{"yes", true},  {"whole", -3}, {"many", std::uint64_t{1} << 63},
                   {"part", 0.25}, {"text", "t"}, {"list", {1, 2, 3}}};
  EXPECT_TRUE(value["yes"].get<bool>());
  EXPECT_EQ(value["whole"].get<int>(), -3);
  EXPECT_EQ(value["many"].get<std::uint64_t>(), std::uint64_t{1} << 63);
  EXPECT_EQ(value["part"].get<double>(), 0.25);
  EXPECT_EQ(value["text"].get<std::string>(), "t");
  EXPECT_EQ((value["list"].get<std::array<double, 3>>()), (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ((value["list"].get<std::vector<std::uint8_t>>()), (std::vector<std::uint8_t>{1, 2, 3}));
  const double implicitly = value["part"];
  const std::string text = value["text"];
  EXPECT_EQ(implicitly, 0.25);
  EXPECT_EQ(text, "t");
}

TEST(JsonValue, ValueOfAnotherKindIsRefusedWithWhatWasFound) {
  EXPECT_TRUE(names(refusal_of([] { (void)Json("x").get<double>(); }), {"x", "number"}));
  EXPECT_TRUE(names(refusal_of([] { (void)Json(1).get<bool>(); }), {"1", "true", "false"}));
  EXPECT_TRUE(names(refusal_of([] { (void)Json(true).get<int>(); }), {"true", "number", "-2147483648", "2147483647"}));
  EXPECT_TRUE(names(refusal_of([] { (void)Json(nullptr).get<std::string>(); }), {"null", "text"}));
  EXPECT_TRUE(names(refusal_of([] { (void)Json{1, 2}.get<std::array<int, 3>>(); }), {"[1,2]", "array", "3"}));
  EXPECT_NE(refusal_of([] { (void)Json().get<std::vector<int>>(); }), "");
  EXPECT_NE(refusal_of([] { (void)Json{{"a", 1}}.get<std::vector<int>>(); }), "");
  EXPECT_LT(refusal_of([] { (void)Json(std::string(5000, 'x')).get<int>(); }).size(), 150u);
}

TEST(JsonValue, NumberOutsideTheWantedTypeIsRefusedNeverWrapped) {
  for (const Json& value :
       {Json(256), Json(256u), Json(256.5), Json(-1), Json(-1.0), Json(1e300), Json(NAN), Json(INFINITY)}) {
    EXPECT_THROW((void)value.get<std::uint8_t>(), JsonError) << value;
  }
  for (const Json& value : {Json(std::uint64_t{1} << 63), Json(9223372036854775808.0), Json(-9.3e18), Json(NAN)}) {
    EXPECT_THROW((void)value.get<std::int64_t>(), JsonError) << value;
  }
  for (const Json& value : {Json(-1), Json(18446744073709551616.0), Json(-1.0)}) {
    EXPECT_THROW((void)value.get<std::uint64_t>(), JsonError) << value;
  }
  EXPECT_EQ(Json(-9223372036854775808.0).get<std::int64_t>(), std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(Json(255.9).get<std::uint8_t>(), 255);
  EXPECT_EQ(Json(-0.9).get<std::uint64_t>(), 0u);
}

TEST(JsonValue, MissingMemberIsNamed) {
  const Json value{{"a", {{"b", 1}}}};
  EXPECT_TRUE(names(refusal_of([&] { (void)value["other"]; }), {"other", "missing"}));
  EXPECT_TRUE(names(refusal_of([&] { (void)value["a"]["b"]["c"]; }), {"1", "object", "c"}));
  EXPECT_TRUE(names(refusal_of([&] { (void)Json{1, 2}[2]; }), {"entry 2", "array of 2"}));
  EXPECT_NE(refusal_of([&] { (void)value[0]; }), "");
  EXPECT_NE(refusal_of([&] { (void)Json::array().back(); }), "");
  EXPECT_NE(refusal_of([&] { (void)Json().front(); }), "");
  EXPECT_EQ(value.find("other"), nullptr);
  EXPECT_EQ(Json(5).find("a"), nullptr);
  EXPECT_EQ(value.member_or_null("a").member_or_null("b"), 1);
  EXPECT_TRUE(value.member_or_null("x").member_or_null("b").is_null());
}

TEST(JsonValue, FallbackCountsOnlyWhereTheMemberIsMissing) {
  const Json value{{"a", 1}, {"t", "text"}};
  EXPECT_EQ(value.value("a", 7), 1);
  EXPECT_EQ(value.value("b", 7), 7);
  EXPECT_EQ(value.value("t", "none"), "text");
  EXPECT_EQ(value.value("b", "none"), "none");
  EXPECT_EQ(value.value("b", Json::array()), Json::array());
  EXPECT_THROW((void)value.value("t", 7), JsonError);
  EXPECT_THROW((void)Json(5).value("t", 7), JsonError);
  EXPECT_THROW((void)Json().value("t", 7), JsonError);
}

TEST(JsonValue, NullGrowsIntoAnObjectOrAnArrayAndNothingElseDoes) {
  Json object, array, number = 5;
  object["a"]["b"] = 1;
  array.push_back(1);
  array.push_back({{"a", 2}});
  EXPECT_EQ(object.dump(), R"({"a":{"b":1}})");
  EXPECT_EQ(array.dump(), R"([1,{"a":2}])");
  EXPECT_THROW(number["a"] = 1, JsonError);
  EXPECT_THROW(number.push_back(1), JsonError);
  EXPECT_THROW(object.push_back(1), JsonError);
  EXPECT_THROW(array["a"] = 1, JsonError);
}

TEST(JsonValue, ReferenceToAMemberStaysGoodWhileOthersAreAdded) {
  Json value{{"m", 1}};
  Json& kept = value["m"];
  for (int i = 0; i < 1000; ++i) value[std::to_string(i)] = value["m"];
  kept = 2;
  EXPECT_EQ(value["m"], 2);
}

TEST(JsonValue, OnlyArraysAndNullAreIteratedAndOnlyObjectsAndNullHaveItems) {
  int count = 0;
  for (const Json& each : Json{1, 2}) count += each.get<int>();
  for (const Json& each : Json()) count += each.get<int>();
  EXPECT_EQ(count, 3);
  const Json object{{"b", 1}, {"a", 2}};
  std::string names;
  for (const auto& [name, value] : object.items()) names += name + value.dump();
  EXPECT_EQ(names, "a2b1");
  EXPECT_TRUE(Json().items().empty());
  EXPECT_THROW((void)object.begin(), JsonError);
  EXPECT_THROW((void)Json("text").begin(), JsonError);
  EXPECT_THROW((void)Json(5).end(), JsonError);
  EXPECT_THROW((void)Json{1}.items(), JsonError);
}

TEST(JsonValue, ErasesOneMemberOrOneEntry) {
  Json object{{"a", 1}, {"b", 2}}, array{1, 2, 3};
  object.erase("a");
  object.erase("other");
  array.erase(1);
  EXPECT_EQ(object.dump(), R"({"b":2})");
  EXPECT_EQ(array.dump(), "[1,3]");
  EXPECT_THROW(array.erase(2), JsonError);
  EXPECT_THROW(array.erase("a"), JsonError);
  EXPECT_THROW(object.erase(std::size_t{0}), JsonError);
}

TEST(JsonValue, NumbersCompareByValueWhateverTheirType) {
  EXPECT_EQ(Json(1), Json(1u));
  EXPECT_EQ(Json(1), Json(1.0));
  EXPECT_EQ(Json(0.0), Json(-0.0));
  EXPECT_NE(Json(-1), Json(std::numeric_limits<std::uint64_t>::max()));
  EXPECT_NE(Json(1), Json(true));
  EXPECT_NE(Json(0), Json());
  EXPECT_NE(Json(NAN), Json(NAN));
  EXPECT_NE(Json((std::int64_t{1} << 53) + 1), Json(std::int64_t{1} << 53));
  EXPECT_TRUE(Json("a") == "a" && "a" == Json("a") && Json("a") != std::string("b") && Json() == nullptr);
  EXPECT_TRUE(Json{1} == (std::vector<int>{1}) && Json(5) == 5 && Json(true) == true && Json(0.5) != 1);
}

}  // namespace
}  // namespace liana
