#include "host/model/simulation/arm_observer.hpp"

#include <algorithm>
#include <cmath>

namespace liana::simulation {

namespace {

using eigen::ThetaColumn;
using eigen::view;

constexpr double kGap_s = 0.1;      // longer ago: it begins anew
constexpr double kFar_rad = 0.035;  // measured beside predicted: the model does not hold, it begins anew

}  // namespace

void ArmObserver::watch(const ThetaVector& measured_rad, const CableVector& tension_N, const ToldNow& told,
                        double since_s) {
  now_.theta_rad = measured_rad;
  now_.tension_N = tension_N;
  now_.rate_rad_s = now_.ahead_rad = ThetaVector{};
  const ThetaColumn measured = view(measured_rad, thetas_);
  begun_ = begun_ && since_s < kGap_s && (measured - arm_.swing().theta_rad).cwiseAbs().maxCoeff() < kFar_rad;
  const ToldNow before = begun_ ? told_ : told;
  told_ = told;
  if (!begun_) {
    begun_ = arm_.begin(now_, before, told, since_s, step_s_);
    return;
  }
  const int steps = std::max(1, static_cast<int>(std::lround(since_s / step_s_)));
  for (int i = 1; i <= steps && begun_; ++i) begun_ = arm_.step(before.to(told, static_cast<double>(i) / steps));
  const ThetaColumn off = since_s * (measured - arm_.swing().theta_rad);
  arm_.correct(kObserverAngle_1_s * off, kObserverRate_1_s2 * off, kObserverHeld_1_s * off);
  view(now_.rate_rad_s, thetas_) = arm_.swing().rate_rad_s;
  view(now_.ahead_rad, thetas_) = arm_.swing().drums_rad - arm_.swing().theta_rad;
}

}  // namespace liana::simulation
