#include "firmware_like/cable/arm/dither.hpp"

#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/scalar.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::cable {

double advance_dither(double wanted, double tick_s, DitherState& state) noexcept {
  const double step = kDitherSlew_1_s * tick_s;
  const bool was_on = state.share > 0.0;
  state.share += clamp(wanted - state.share, -step, step);
  if (state.share <= 0.0) {
    state.settle_s = was_on ? kDitherSettle_s : larger(0.0, state.settle_s - tick_s);
    state.turn = 0.0;
    return 0.0;
  }
  state.turn += kDither_hz * tick_s;
  if (state.turn >= 1.0) state.turn -= 1.0;
  return state.share * sin_cos(2.0 * kPi * state.turn).sin;
}

bool dither_fits(const RobotParams& table, const CableVector& planned_N, double share) noexcept {
  for (std::int32_t c = table.feed_count(); c < table.cable_count(); ++c) {
    const double planned = planned_N[as_index(c)];
    if (planned * (1.0 - share) < table.tension.floor_motor_N) return false;
    if (planned * (1.0 + share) > table.tension.ceiling_free_N) return false;
  }
  return true;
}

}  // namespace liana::cable
