#include "host/operator/terminal/keys.hpp"

#include <gtest/gtest.h>

#include <string>

namespace liana::terminal {
namespace {

TEST(Keys, LettersCountInBothCasesAndOthersMeanNothing) {
  EXPECT_EQ(key_of('w')->direction.way[0], 1.0);
  EXPECT_EQ(key_of('W')->name, 'w');
  EXPECT_EQ(key_of('O')->direction.turn[0], 1.0);
  for (const char byte : {'1', '\n', '~', '\0', '\x7f', '\xff'}) EXPECT_FALSE(key_of(byte)) << static_cast<int>(byte);
}

TEST(Keys, EveryJogHasAnOpposite) {
  Vec3 ways{}, turns{};
  int jogs = 0;
  for (char byte = 'a'; byte <= 'z'; ++byte) {
    const auto key = key_of(byte);
    if (!key || key->deed != Deed::kJog) continue;
    ++jogs;
    ways = add(ways, key->direction.way);
    turns = add(turns, key->direction.turn);
  }
  EXPECT_EQ(jogs, 12);
  EXPECT_EQ(ways, Vec3{});
  EXPECT_EQ(turns, Vec3{});
}

TEST(Keys, ArrowsAreTheLettersInTheirPlaces) {
  std::string names;
  for (const Key& key : keys_in("\x1b[A\x1b[B\x1bOC\x1b[D")) names += key.name;
  EXPECT_EQ(names, "wsda");
}

TEST(Keys, EscapeIsAStopAloneAndBeforeAnythingThatIsNotKnown) {
  for (const char* bytes : {"\x1b", "\x1b[", "\x1b[5~", "\x1b\x1b", "\x1bw"}) {
    const auto keys = keys_in(bytes);
    ASSERT_FALSE(keys.empty()) << bytes + 1;
    EXPECT_EQ(keys[0].deed, Deed::kStop) << bytes + 1;
  }
}

}  // namespace
}  // namespace liana::terminal
