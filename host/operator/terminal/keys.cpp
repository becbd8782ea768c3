#include "host/operator/terminal/keys.hpp"

#include <array>
#include <utility>

namespace liana::terminal {
namespace {

constexpr char kEscape = '\x1b';
constexpr char kControlC = '\x03', kControlD = '\x04';

struct Jog {
  char name;
  Direction direction;
};

constexpr std::array<Jog, 12> kJogs{{
    {'w', {{1, 0, 0}, {}}},
    {'s', {{-1, 0, 0}, {}}},
    {'a', {{0, 1, 0}, {}}},
    {'d', {{0, -1, 0}, {}}},
    {'e', {{0, 0, 1}, {}}},
    {'q', {{0, 0, -1}, {}}},
    {'j', {{}, {0, 0, 1}}},
    {'l', {{}, {0, 0, -1}}},
    {'i', {{}, {0, -1, 0}}},
    {'k', {{}, {0, 1, 0}}},
    {'u', {{}, {-1, 0, 0}}},
    {'o', {{}, {1, 0, 0}}},
}};

constexpr std::array<std::pair<char, Deed>, 15> kDeeds{{
    {' ', Deed::kStop},
    {kEscape, Deed::kStop},
    {'h', Deed::kHold},
    {'t', Deed::kTake},
    {'n', Deed::kEnable},
    {'b', Deed::kDisable},
    {'c', Deed::kClear},
    {'r', Deed::kRetract},
    {'+', Deed::kFaster},
    {'=', Deed::kFaster},  // the same key, without shift
    {'-', Deed::kSlower},
    {'f', Deed::kFrame},
    {'x', Deed::kEnd},
    {kControlC, Deed::kEnd},
    {kControlD, Deed::kEnd},
}};

char lower(char byte) { return byte >= 'A' && byte <= 'Z' ? static_cast<char>(byte - 'A' + 'a') : byte; }

// The letter in an arrow's place; 0 for any other sequence.
char letter_of_arrow(char final) {
  constexpr std::string_view kFinals = "ABCD", kLetters = "wsda";
  const std::size_t place = kFinals.find(final);
  return place == std::string_view::npos ? '\0' : kLetters[place];
}

}  // namespace

std::optional<Key> key_of(char byte) {
  const char key = lower(byte);
  for (const Jog& jog : kJogs) {
    if (jog.name == key) return Key{Deed::kJog, jog.name, jog.direction};
  }
  for (const auto& [name, deed] : kDeeds) {
    if (name == key) return Key{deed, 0, {}};
  }
  return std::nullopt;
}

std::vector<Key> keys_in(std::string_view bytes) {
  std::vector<Key> keys;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    char byte = bytes[i];
    const bool is_sequence = byte == kEscape && i + 2 < bytes.size() && (bytes[i + 1] == '[' || bytes[i + 1] == 'O');
    if (const char letter = is_sequence ? letter_of_arrow(bytes[i + 2]) : '\0'; letter != '\0') {
      byte = letter;
      i += 2;
    }
    if (const auto key = key_of(byte)) keys.push_back(*key);
  }
  return keys;
}

}  // namespace liana::terminal
