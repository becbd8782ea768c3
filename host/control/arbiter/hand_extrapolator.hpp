// Where a hand is taken to be while nobody sees it: it goes on as it went.
//
// A hand that is followed at 60 mm/s and stands still for the 0.15 s that a tracker is blind makes the arm brake and
// catch up with 10 mm at once. That is half a period of its own swing, and takes up to 20 N off a cable.
#pragma once

#include "firmware_like/math/pose.hpp"
#include "host/control/arbiter/hand_track.hpp"

namespace liana::arbiter {

constexpr double kHandVelocity_s = 0.15;  // over which a hand's velocity is averaged: more than a period of its tremor

// One hand while its deadman is closed. It goes on for kTrackingLost_s at most, then it stands.
class HandExtrapolator {
 public:
  // Forgets how the hand went.
  void forget() { *this = HandExtrapolator{}; }
  // An interval of `interval_s` in which the hand was seen at `hand`, in the device frame.
  void see(const Pose& hand, double interval_s);
  // One without: where it is taken to be by now. Only after it was seen.
  const Pose& go_on(double interval_s);

 private:
  Pose at_{};            // seen, or gone on to
  Pose seen_{};          // last
  Vec3 velocity_m_s_{};  // low-passed
  Vec3 rate_rad_s_{};    // low-passed
  double unseen_s_ = 0.0;
  bool any_ = false;
};

}  // namespace liana::arbiter
