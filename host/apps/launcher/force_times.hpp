// When what happens in a self-test of the force estimate, in seconds of arm time.
#pragma once

namespace liana::launcher {

constexpr double kFirstBlock_s = 8.0;  // the arm is enabled by then
constexpr double kRise_s = 1.5;        // of a push, and of its fall
constexpr double kFading_s = 3.0;      // after a push has begun to fall nothing of it is told any more

// One push takes a block: the arm goes somewhere and rests, is pushed, is dithered under the push, is let go, and is
// pushed again on its way to the next place. Times from the block's begin.
struct PushTimes {
  double begin_s, end_s;
};
constexpr double kGo_s = 0.0;
constexpr PushTimes kAtRest{17.0, 31.0};
constexpr double kReadStill_s = 21.5;
constexpr double kDither_s = 22.0;
constexpr double kReadDithered_s = 30.5;
constexpr double kMove_s = 35.0;
constexpr PushTimes kOnTheMove{37.5, 43.0};
constexpr double kReadMoving_s = 42.5;
constexpr double kBlock_s = 52.0;

}  // namespace liana::launcher
