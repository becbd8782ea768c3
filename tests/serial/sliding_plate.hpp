// A plate that is pushed along a constant direction and damped, as an arm under force control would lead it; it does
// not turn.
#pragma once

#include <algorithm>

#include "hil/serial/adapter.hpp"

namespace liana::bench {

struct SlidingPlate {
  double mass_kg;
  double damping_Ns_m;
  Vec3 at_m;
  Vec3 velocity_m_s{};
  double hardest_N = 0.0;  // of the adapter, so far

  TipState state() const { return {{at_m, {}}, velocity_m_s, {}}; }

  void run(Adapter& adapter, const Vec3& push_N, double seconds) {
    constexpr double kStep_s = 0.00025;
    for (double t = 0.0; t < seconds; t += kStep_s) {
      at_m = at_m + 0.5 * kStep_s * velocity_m_s;
      const Vec3 force = adapter.push(state()).force_N;
      hardest_N = std::max(hardest_N, norm(force));
      const Vec3 accel = (1.0 / mass_kg) * (push_N + force - damping_Ns_m * velocity_m_s);
      velocity_m_s = velocity_m_s + kStep_s * accel;
      at_m = at_m + 0.5 * kStep_s * velocity_m_s;
      adapter.step(kStep_s, state());
    }
  }
};

}  // namespace liana::bench
