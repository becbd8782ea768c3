// Where in a JSON text the number is that no double holds, for messages: the library says only what it is.
#pragma once

#include <string>

namespace liana::bench {

struct NumberOverflow {
  std::string field;   // "/a/b/0", as JsonFile names fields; empty when the number is the whole text
  std::string number;  // as written
};

// The first one; `number` is empty when there is none, or something else is wrong before it.
NumberOverflow first_overflow(const std::string& text);

}  // namespace liana::bench
