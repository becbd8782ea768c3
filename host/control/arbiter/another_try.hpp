// What becomes of a motion that verification refused because of how the arm would swing: from rest, and slower, the
// same may pass.
#pragma once

#include <cstdint>
#include <utility>

namespace liana::arbiter {

class AnotherTry {
 public:
  // Refused: whether it is tried again; then the arm comes to rest first.
  bool refused() {
    if (tries_ == kMaxTries) return false;
    ++tries_;
    rests_ = waited_ = 0;
    waits_ = begins_ = true;
    return true;
  }
  // Once per command interval: whether nothing is asked for yet. Bounded: an arm that swings on is asked all the same.
  bool waits(bool at_rest) {
    rests_ = at_rest ? rests_ + 1 : 0;
    waits_ = waits_ && rests_ < (kRestIntervals << (2 * (tries_ - 1))) && ++waited_ < kMaxWaitIntervals;
    return waits_;
  }
  // After a wait: whether the motion is to be planned anew, which is said once.
  bool begins_again() { return std::exchange(begins_, false); }
  // Of the speed that was asked for first: half as much at each try.
  double speed_share() const { return 1.0 / static_cast<double>(1 << tries_); }

 private:
  static constexpr int kMaxTries = 4;
  // What is at rest by its command still swings; at each further try four times as long, as a slack cable is wound in.
  static constexpr std::int32_t kRestIntervals = 15;
  static constexpr std::int32_t kMaxWaitIntervals = 1000;

  int tries_ = 0;
  std::int32_t rests_ = 0, waited_ = 0;
  bool waits_ = false, begins_ = false;
};

}  // namespace liana::arbiter
