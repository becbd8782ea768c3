// Whatever document: the same bytes out and the same answers as nlohmann::json gives.
#include <gtest/gtest.h>

#include <bit>
#include <nlohmann/json.hpp>
#include <random>

#include "host/base/json/json.hpp"
#include "tests/rounds.hpp"

namespace liana {
namespace {

using Library = nlohmann::json;

// A double of random bits (finite, or not), or one near a whole or decimal number, where formats change.
double random_double(std::mt19937_64& random) {
  const double bits = std::bit_cast<double>(random());
  switch (random() % 4) {
    case 0:
      return static_cast<double>(static_cast<std::int64_t>(random() % 2'000'001) - 1'000'000) / 1000.0;
    case 1:
      return std::ldexp(static_cast<double>(random() % 1024), static_cast<int>(random() % 140) - 70);
    case 2:
      return std::pow(10.0, static_cast<double>(random() % 40) - 20.0) * static_cast<double>(random() % 1000);
    default:
      return bits;
  }
}

// Texts of all bytes that matter: plain, control, quotes, two to four bytes of UTF-8.
std::string random_text(std::mt19937_64& random) {
  static const std::vector<std::string> kPieces{"a",
                                                "key",
                                                "\"",
                                                "\\",
                                                "/",
                                                "\n",
                                                "\x01",
                                                "\x1f",
                                                "\x7f",
                                                "\xc3\xa4",
                                                "\xe2\x82\xac",
                                                "\xf0\x9f\x98\x80",
                                                "\t",
                                                " ",
                                                "\b",
                                                "\f",
                                                "\r",
                                                "\xe2\x80\xa8",
                                                std::string(1, '\0')};
  std::string text;
  for (std::uint64_t n = random() % 6; n > 0; --n) text += kPieces[random() % kPieces.size()];
  return text;
}

Library random_document(std::mt19937_64& random, int levels) {
  switch (random() % (levels > 0 ? 9 : 6)) {
    case 0:
      return nullptr;
    case 1:
      return random() % 2 == 0;
    case 2:
      return static_cast<std::int64_t>(random()) >> (random() % 64);
    case 3:
      return random() >> (random() % 64);
    case 4:
      return random_double(random);
    case 5:
      return random_text(random);
    case 6: {
      Library array = Library::array();
      for (std::uint64_t n = random() % 5; n > 0; --n) array.push_back(random_document(random, levels - 1));
      return array;
    }
    default: {
      Library object = Library::object();
      for (std::uint64_t n = random() % 5; n > 0; --n)
        object[random_text(random)] = random_document(random, levels - 1);
      return object;
    }
  }
}

// The same value, built through the interface instead of through text.
Json rebuilt(const Library& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number_unsigned()) return value.get<std::uint64_t>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  Json out;
  if (value.is_array()) out = Json::array();
  if (value.is_object()) out = Json::object();
  for (const auto& [key, each] : value.items()) {
    if (value.is_array()) out.push_back(rebuilt(each));
    if (value.is_object()) out[key] = rebuilt(each);
  }
  return out;
}

// What a terminal would act on is told as \u, which the library does of ASCII's controls alone.
std::string escaped(std::string text) {
  for (const auto& [character, code] : {std::pair{"\x7f", "\\u007f"}, std::pair{"\u2028", "\\u2028"}}) {
    const std::size_t size = std::string_view(character).size();
    for (std::size_t at = text.find(character); at != text.npos; at = text.find(character, at))
      text.replace(at, size, code);
  }
  return text;
}

void expect_same(const Json& ours, const Library& theirs) {
  ASSERT_EQ(ours.dump(), escaped(theirs.dump()));
  EXPECT_EQ(ours.dump(2), escaped(theirs.dump(2)));
  EXPECT_EQ(ours.size(), theirs.size());
  EXPECT_EQ(ours.empty(), theirs.empty());
  EXPECT_EQ(ours.is_null(), theirs.is_null());
  EXPECT_EQ(ours.is_boolean(), theirs.is_boolean());
  EXPECT_EQ(ours.is_number(), theirs.is_number());
  EXPECT_EQ(ours.is_number_integer(), theirs.is_number_integer());
  EXPECT_EQ(ours.is_number_unsigned(), theirs.is_number_unsigned());
  EXPECT_EQ(ours.is_number_float(), theirs.is_number_float());
  EXPECT_EQ(ours.is_string(), theirs.is_string());
  EXPECT_EQ(ours.is_array(), theirs.is_array());
  EXPECT_EQ(ours.is_object(), theirs.is_object());
  EXPECT_EQ(ours.contains("key"), theirs.contains("key"));
  if (ours.is_number()) {
    EXPECT_EQ(std::bit_cast<std::uint64_t>(ours.get<double>()), std::bit_cast<std::uint64_t>(theirs.get<double>()));
  }
  if (ours.is_string()) {
    EXPECT_EQ(ours.get<std::string>(), theirs.get<std::string>());
  }
  for (std::size_t i = 0; ours.is_array() && i < ours.size(); ++i) expect_same(ours[i], theirs[i]);
  if (!ours.is_object()) return;
  auto there = theirs.begin();
  for (const auto& [key, value] : ours.items()) {
    EXPECT_EQ(key, there.key());
    expect_same(value, (there++).value());
  }
}

TEST(SameAsLibrary, RandomDocumentsAreReadBuiltAndPrintedAlike) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 3000; ++i) {
    const Library theirs = random_document(random, 5);
    expect_same(rebuilt(theirs), theirs);
    const std::string text = theirs.dump();
    expect_same(Json::parse(text), Library::parse(text));
    EXPECT_EQ(Json::parse(text), Json::parse(theirs.dump(3)));
  }
}

TEST(SameAsLibrary, MillionDoublesArePrintedAlike) {
  std::mt19937_64 random(2);
  for (int i = 0; i < rounds(1'000'000); ++i) {
    const double value = random_double(random);
    ASSERT_EQ(Json(value).dump(), Library(value).dump());
  }
}

TEST(SameAsLibrary, SpoiledTextsAreAcceptedAndRefusedAlike) {
  std::mt19937_64 random(3);
  int accepted = 0;
  for (int i = 0; i < rounds(30'000); ++i) {
    std::string text = random_document(random, 3).dump();
    const std::size_t at = random() % text.size();
    if (random() % 2 == 0) {
      text[at] = static_cast<char>(1 + random() % 255);
    } else {
      text.erase(at, 1 + random() % 3);
    }
    const Library theirs = Library::parse(text, nullptr, false);
    accepted += theirs.is_discarded() ? 0 : 1;
    try {
      const Json ours = Json::parse(text);
      ASSERT_FALSE(theirs.is_discarded()) << text;
      EXPECT_EQ(Library::parse(ours.dump()), theirs);
    } catch (const JsonParseError&) {
      ASSERT_TRUE(theirs.is_discarded()) << text;
    }
  }
  EXPECT_GT(accepted, rounds(1000));
  EXPECT_LT(accepted, rounds(29'000));
}

TEST(SameAsLibrary, BracedListsMeanTheSame) {
  const std::string word = "w";
  const Json ours{{"a", {}},          {"b", {1}}, {"c", {"x", 1}}, {"d", {{"x", 1}}}, {"e", {{"x", 1}, {"y", {2, 3}}}},
                  {"f", {word, word}}};
  const Library theirs{
      {"a", {}}, {"b", {1}}, {"c", {"x", 1}}, {"d", {{"x", 1}}}, {"e", {{"x", 1}, {"y", {2, 3}}}}, {"f", {word, word}}};
  EXPECT_EQ(ours.dump(), theirs.dump());
  EXPECT_EQ(Json({}).dump(), Library({}).dump());
  EXPECT_EQ((Json{"a", "b"}).dump(), (Library{"a", "b"}).dump());
  EXPECT_EQ((Json{{"a", "b"}}).dump(), (Library{{"a", "b"}}).dump());
  EXPECT_EQ((Json{{{"a", "b"}}}).dump(), (Library{{{"a", "b"}}}).dump());
  EXPECT_EQ((Json{{{"a", "b"}}, {{"c", "d"}}}).dump(), (Library{{{"a", "b"}}, {{"c", "d"}}}).dump());
  EXPECT_EQ((Json{{"a", 1}, {"a", 2}}).dump(), (Library{{"a", 1}, {"a", 2}}).dump());
  EXPECT_EQ(Json::array({1}).dump(), Library::array({1}).dump());
}

}  // namespace
}  // namespace liana
