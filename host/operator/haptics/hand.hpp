// A simulated human hand that holds a device: where the person wants to be, with reaction time and tremor, and a spring
// and a damper from there to the hand's mass.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/math/pose.hpp"
#include "host/operator/simulated/tremor.hpp"

namespace liana::haptics {

// What the person wants, given from outside once a millisecond.
struct Intent {
  Vec3 position_m{};    // in the device's frame
  Vec3 wrist_rad{};     // the wrist's three angles
  bool button = false;  // held: the arm shall follow
};

// Assumed; the stiffness of arms that F. Mussa-Ivaldi, N. Hogan and E. Bizzi measured (J. Neurosci. 5, 1985) lies
// within the range.
struct HandParams {
  double mass_kg = 0.5;          // that moves with the device; 0.5 wrist only .. 2 whole forearm
  double stiffness_N_m = 300.0;  // 0 lets go .. 1000 clenched
  double damping_ratio = 0.3;
  double min_damping_N_s_m = 2.0;  // also of a hand that has let go
  double tremor_m = 0.0001;        // RMS of each axis, of a hand that only bears its own mass (as HandGains::tremor_m)
  double reaction_s = 0.15;        // 0 .. 0.5 (as HandGains::reaction_s)
};

// Deterministic: the same calls give the same hand. No heap.
class Hand {
 public:
  // `moved_kg`: what moves with the hand besides its own mass; it enters damping and tremor.
  Hand(const HandParams& table, double moved_kg, std::uint64_t seed);

  // The next millisecond's intent; it is acted on after the reaction time. Before the first one has come through, the
  // first one of all counts.
  void intend(const Intent& intent) noexcept;
  // What the person acts on now.
  const Intent& acted() const noexcept { return acted_; }
  // Begins the millisecond at `t_s`: the tremor's force is held over it.
  void tremble(double t_s) noexcept;
  // Force [N] of the arm on what it holds.
  Vec3 force(const Vec3& position_m, const Vec3& velocity_m_s) const noexcept;

  double mass_kg() const { return table_.mass_kg; }

 private:
  static constexpr std::size_t kLongest = 501;  // [ms] of reaction time

  HandParams table_;
  simulated::Tremor tremor_;  // of one unit
  double damping_N_s_m_;
  double tremor_N_;
  std::size_t reaction_;  // [ms]
  std::array<Intent, kLongest> waiting_{};
  std::size_t next_ = 0;
  bool begun_ = false;
  Intent acted_{};
  Vec3 speed_m_s_{};  // of the intent
  Vec3 trembling_N_{};
};

}  // namespace liana::haptics
