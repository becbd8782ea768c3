// How long a seeded test goes on.
#pragma once

#include <concepts>

namespace liana {

// Rounds of a test that takes `all` of them: a tenth where sanitizers look, which makes each take about ten times as
// long. What they look for is in the first ones; what the figures need is in the whole (`./dev test FOLDER`).
template <std::integral T>
constexpr T rounds(T all) {
#ifdef LIANA_SANITIZED
  return (all + 9) / 10;
#else
  return all;
#endif
}

}  // namespace liana
