// The person's feeling for the arm: where the hand has sent the tip, and how far off the tip is seen to be.
#pragma once

#include <vector>

#include "host/operator/simulated/hand_gains.hpp"
#include "host/operator/simulated/slit_view.hpp"

namespace liana::simulated {

// Poses in the slit frame. Corrections integrate what is seen against what the hand should have done by the time of the
// picture, so the arm's lag and the picture's age do not turn into overshoot.
class Aim {
 public:
  explicit Aim(const HandGains& gains);

  // Starts a grip at the tip pose that is seen: nothing is known to be off yet.
  void reset(const Pose& seen_tip);
  // One step of `dt_s` (constant, 1 ms): the hand wants the tip at `intended`.
  void advance(const Pose& intended, double dt_s);
  // A picture, `since_last_s` after the one before; errors along `ignored` (a step's directions) are lag and stay.
  void see(const Pose& seen_tip, double since_last_s, const PoseStep& ignored);

  // Where the hand sends the tip: intended, less what is seen to be off.
  const Pose& commanded() const { return commanded_; }
  // How far the tip is off, as learned so far.
  const PoseStep& learned() const { return learned_; }
  // Last picture against expectation, learned part removed [m].
  double surprise_m() const { return surprise_m_; }

 private:
  HandGains gains_;
  Pose commanded_{};
  Pose lagged_{};
  PoseStep learned_{};
  double surprise_m_ = 0.0;
  std::vector<Pose> history_;  // ring of expected tip poses, one per step
  std::size_t head_ = 0;
};

}  // namespace liana::simulated
