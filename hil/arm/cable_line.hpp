// One elastic cable with rate-independent capstan friction: its stuck and slipped material is the state.
#pragma once

#include <array>
#include <cstddef>

#include "hil/arm/cable_geometry.hpp"

namespace liana::bench {

// The cable is cut into spans at one friction lump in the middle of every segment it passes: span 0 runs from the drum
// through half of segment 0, span j from the middle of segment j-1 to that of segment j, the last one to the anchor. A
// lump holds a tension ratio up to exp(mu wrap) and lets material through beyond it (Euler-Eytelwein), so the cable
// sticks, shows hysteresis and keeps tension gradients.
class CableLine {
 public:
  // Lays the cable along the present paths with one tension everywhere and nothing held by friction.
  CableLine(const CablePaths& paths, std::size_t cable, double lead_m, double EA_N, double mu, double tension_N);

  // Unstretched material between drum and anchor [m].
  double payout_m() const;
  // Drum at `payout_m`, arm at the paths: lets material slip until every lump holds. Returns the number of sweeps it
  // took.
  int settle(const CablePaths& paths, double payout_m);

  // At the drum, at the emptiest span, and averaged over the two sides of a segment's lump [N].
  double motor_tension_N() const { return tension_N_[0]; }
  double least_tension_N() const;
  double segment_tension_N(std::size_t segment) const {
    return 0.5 * (tension_N_[segment - first_] + tension_N_[segment - first_ + 1]);
  }
  // Adds what the cable resists turns of the angles with while friction holds all its material, which is when it is
  // stiffest [N.m/rad].
  void add_stiffness(const CablePaths& paths, ThetaMatrix& stiffness) const;
  // Elastic energy stored [J].
  double energy_J() const;

 private:
  void lay_out(const CablePaths& paths);
  void spread_evenly();
  bool slip(std::size_t lump);
  double span_tension(std::size_t span) const;

  std::size_t cable_;
  std::size_t first_;  // segment that it passes first; it has no lump in a base
  std::size_t lumps_;
  double lead_m_;
  double EA_N_;
  double mu_;
  std::array<double, kMaxSegments + 1> length_m_{};
  std::array<double, kMaxSegments + 1> material_m_{};  // unstretched, per span
  std::array<double, kMaxSegments + 1> tension_N_{};
  std::array<double, kMaxSegments> ratio_{};  // largest tension ratio over a lump, >= 1
  std::array<bool, kMaxSegments> held_{};     // found so, with the tensions beside it as they are
};

}  // namespace liana::bench
