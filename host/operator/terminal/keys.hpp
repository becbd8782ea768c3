// What keys of a terminal mean: the same places as in the console's page (docs/how-to/teleoperate.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::terminal {

// Velocity that a key asks for, along and about x, y, z; each -1 to 1.
struct Direction {
  Vec3 way{};
  Vec3 turn{};
};

enum class Deed { kJog, kStop, kHold, kTake, kEnable, kDisable, kClear, kRetract, kFaster, kSlower, kFrame, kEnd };

struct Key {
  Deed deed = Deed::kJog;
  char name = 0;        // of a jog: the key that is held
  Direction direction;  // of a jog
};

// Nothing for a byte that means nothing. Letters count in both cases.
std::optional<Key> key_of(char byte);

// The keys in what a terminal sent at once. An arrow is the letter in its place (W, A, S, D); Escape alone, or before
// anything else that is not known, is a stop: too many are better than one too few.
std::vector<Key> keys_in(std::string_view bytes);

}  // namespace liana::terminal
