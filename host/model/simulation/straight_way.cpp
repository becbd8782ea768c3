#include "host/model/simulation/straight_way.hpp"

#include <algorithm>
#include <cmath>

namespace liana::simulation {

namespace {

// How long each end lasts: v = way / (T - t) and v = a t.
double end_s(double way_rad, double accel_rad_s2, double duration_s) {
  const double half_s = 0.5 * duration_s;
  return half_s - std::sqrt(std::fmax(0.0, half_s * half_s - way_rad / accel_rad_s2));
}

double share_at(double time_s, double end_s, double duration_s) {
  const double rate_1_s = 1.0 / (duration_s - end_s);
  if (time_s < end_s) return 0.5 * rate_1_s * time_s * time_s / end_s;
  const double left_s = std::fmax(0.0, duration_s - time_s);
  if (left_s < end_s) return 1.0 - 0.5 * rate_1_s * left_s * left_s / end_s;
  return rate_1_s * (time_s - 0.5 * end_s);
}

template <class Joints>
ToldRows<Joints> way_between(const Joints& from_rad, const Joints& to_rad, double ends_s, double duration_s,
                             double interval_s) {
  ToldRows<Joints> out{interval_s, {}};
  const auto rows = static_cast<std::int64_t>(std::ceil(duration_s / interval_s - 1e-9));
  for (std::int64_t row = 0; row < rows; ++row) {
    const double share = share_at(static_cast<double>(row) * interval_s, ends_s, duration_s);
    Joints joint_rad{};
    for (std::size_t k = 0; k < joint_rad.size(); ++k) joint_rad[k] = from_rad[k] + share * (to_rad[k] - from_rad[k]);
    out.rows_rad.push_back(joint_rad);
  }
  out.rows_rad.push_back(to_rad);
  return out;
}

}  // namespace

JointSequence straight_way(const RobotParams& table, const ThetaVector& from_rad, const ThetaVector& to_rad,
                           double duration_s, double interval_s) {
  double way_rad = 0.0;
  for (std::size_t k = 0; k < from_rad.size(); ++k) way_rad = std::max(way_rad, std::fabs(to_rad[k] - from_rad[k]));
  const double ends_s = end_s(way_rad, table.limits.theta_accel_rad_s2, duration_s);
  return {way_between(from_rad, to_rad, ends_s, duration_s, interval_s), {}, {}};
}

ToldRows<serial::JointVector> straight_way(const serial::RobotParams& table, const serial::JointVector& from_rad,
                                           const serial::JointVector& to_rad, double duration_s, double interval_s) {
  double ends_s = 0.0;
  for (std::size_t i = 0; i < table.joints(); ++i)
    ends_s = std::max(ends_s, end_s(std::fabs(to_rad[i] - from_rad[i]), table.joint[i].accel_rad_s2, duration_s));
  return way_between(from_rad, to_rad, ends_s, duration_s, interval_s);
}

}  // namespace liana::simulation
