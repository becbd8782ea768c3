// What the classes of the corpus share.
#pragma once

#include <string>
#include <vector>

#include "tests/host/control/verification/corpus.hpp"

namespace liana::verification::corpus {

using namespace cable;
using zhu2022::Random;

constexpr std::size_t kThetas = zhu2022::kThetas;

// Limits that no command here comes near to, but for the one that is looked at.
inline RobotParams patient() {
  RobotParams table = zhu2022::table();
  table.limits.tip_speed_m_s = 10.0;
  table.limits.tip_speed_slit_m_s = 10.0;
  table.limits.tip_rate_rad_s = 10.0;
  table.limits.theta_rate_rad_s = 1.0;
  table.limits.theta_accel_rad_s2 = 0.05 * kDegree;
  return table;
}

inline ThetaVector turned(ThetaVector theta_rad, std::size_t k, double by_rad) {
  theta_rad[k] += by_rad;
  return theta_rad;
}

inline ThetaVector along(const ThetaVector& from_rad, const ThetaVector& to_rad, double share) {
  ThetaVector theta_rad{};
  for (std::size_t k = 0; k < kThetas; ++k) theta_rad[k] = from_rad[k] + share * (to_rad[k] - from_rad[k]);
  return theta_rad;
}

inline std::string named(const char* what, std::size_t index, bool outside) {
  return what + std::string(" ") + std::to_string(index) + (outside ? ", outside" : ", inside");
}

// Both sides of one limit.
template <class Make>
void both_sides(std::vector<Command>& out, const Make& make) {
  for (const bool outside : {false, true}) out.push_back(make(outside));
}

}  // namespace liana::verification::corpus
