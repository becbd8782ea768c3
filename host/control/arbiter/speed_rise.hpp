// The tip speed that is asked for falls at once and rises slowly.
#pragma once

#include <algorithm>

namespace liana::arbiter {

// A goal that has run ahead of a slow tip pulls at it as soon as it may be fast again. Asked for 0.10 m/s at once after
// 0.027, before the mouth, the true tip swings up to 0.14; risen as slowly as this it goes no faster than it is asked
// to, and has not become so fast that cables come near slack where the goal stands.
class SpeedRise {
 public:
  static constexpr double kMost_m_s = 1.0;  // faster than any tip

  // Once per command interval of `dt_s`.
  void pass(double dt_s) { max_m_s_ = std::min(max_m_s_ + kRise_m_s2 * dt_s, kMost_m_s); }
  // What to ask for now of what is wanted [m/s].
  double limited(double wanted_m_s) { return max_m_s_ = std::min(max_m_s_, wanted_m_s); }

 private:
  static constexpr double kRise_m_s2 = 0.006;

  double max_m_s_ = kMost_m_s;
};

}  // namespace liana::arbiter
