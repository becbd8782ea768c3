// The least clearance of a whole motion from single poses of it, certain also between them.
//
// From a pose with clearance c the arm has to move by c - d before it can be as near as d. So between two poses with
// clearances a and b, from the first of which to the second no point of the arm goes farther than s, the clearance is
// never below (a + b - s) / 2. A motion is halved only where that could be the least: a plate of any thickness between
// two poses is seen, and where the arm is far from everything two poses are all that is looked at.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include "host/model/clearance/clearance.hpp"

namespace liana::clearance {

// A motion as poses 0 .. gone_m.size() - 1, and what is asked of it.
struct Motion {
  // How far any one point of the arm can have gone from pose 0 to pose i [m]: a bound that never falls, with whatever
  // the arm does between two poses in it.
  std::span<const double> gone_m;
  double pace = 1.0;      // how fast the distance asked for changes with that: 1 to a scene, 2 within the arm
  double enough_m = 0.0;  // distances beyond need not be told apart
  double unseen_m = 0.0;  // what the bound may be below the least pose so that fewer poses are looked at
};

// What is known of it; Found is what one pose is known by: it has distance_m().
template <class Found>
struct AlongMotion {
  double at_least_m = kNoObstacle_m;  // a bound: nowhere in the whole motion less; with nothing near Motion::enough_m
  Found nearest{};                    // the least of the poses looked at,
  std::int32_t pose = -1;             // and which of them that is; -1: the motion is empty
  std::int32_t looks = 0;             // poses looked at
};

template <class Look>
class MotionSearch {
 public:
  using Found = std::invoke_result_t<Look, std::int32_t>;

  MotionSearch(const Motion& motion, Look& look) : motion_(motion), look_(look), min_m_(motion.enough_m) {}

  AlongMotion<Found> run() {
    const std::int32_t last = static_cast<std::int32_t>(motion_.gone_m.size()) - 1;
    if (last < 0) return out_;
    out_.at_least_m = motion_.enough_m;
    const double first_m = look_at(0);
    open(0, last, first_m, last > 0 ? look_at(last) : first_m);
    while (waiting_ > 0) search(open_[--waiting_]);
    return out_;
  }

 private:
  // Poses that were looked at, and nothing between them.
  struct Piece {
    std::int32_t from, to;
    double from_m, to_m;
    double at_least_m;  // of all between them, both included
  };

  // What is no number is as near as can be.
  static double sure(double distance_m) { return distance_m <= kNoObstacle_m ? distance_m : -kNoObstacle_m; }

  double look_at(std::int32_t pose) {
    const Found found = look_(pose);
    const double here_m = sure(found.distance_m());
    if (out_.pose < 0 || here_m < min_look_m_) out_.nearest = found, out_.pose = pose, min_look_m_ = here_m;
    min_m_ = std::min(min_m_, here_m);
    ++out_.looks;
    return here_m;
  }

  void open(std::int32_t from, std::int32_t to, double from_m, double to_m) {
    const double way_m = motion_.gone_m[static_cast<std::size_t>(to)] - motion_.gone_m[static_cast<std::size_t>(from)];
    const double between_m = sure(0.5 * (from_m + to_m - motion_.pace * way_m));
    open_[waiting_++] = {from, to, from_m, to_m, std::min({from_m, to_m, between_m})};
  }

  void search(Piece piece) {
    if (piece.at_least_m >= min_m_ - motion_.unseen_m || piece.to <= piece.from + 1) {
      out_.at_least_m = std::min(out_.at_least_m, piece.at_least_m);
      return;
    }
    const std::int32_t middle = piece.from + (piece.to - piece.from) / 2;
    const double middle_m = look_at(middle);
    open(piece.from, middle, piece.from_m, middle_m);
    open(middle, piece.to, middle_m, piece.to_m);
    // The nearer half first: what it finds may spare the other.
    if (open_[waiting_ - 2].at_least_m < open_[waiting_ - 1].at_least_m)
      std::swap(open_[waiting_ - 2], open_[waiting_ - 1]);
  }

  const Motion& motion_;
  Look& look_;
  AlongMotion<Found> out_;
  double min_m_;  // of all looks and enough_m
  double min_look_m_ = kNoObstacle_m;
  std::array<Piece, 64> open_;  // halving leaves one piece waiting each time, at most 32 times
  std::size_t waiting_ = 0;
};

// `look(pose)` measures one pose. The bound is below the least pose by `unseen_m` or by half of what the arm goes from
// one pose to the next, whichever is more. A travel or distance that is no number makes it -kNoObstacle_m. Cost: at
// most one look a pose, two in all where the arm stays away by more than it moves.
template <class Look>
auto min_along(const Motion& motion, Look look) {
  return MotionSearch<Look>(motion, look).run();
}

}  // namespace liana::clearance
