// Where the tip has to be slow: inside the slit, and on the way down to that speed before its mouth.
#pragma once

#include <cmath>
#include <optional>

#include "firmware_like/math/pose.hpp"
#include "host/model/config/config.hpp"

namespace liana::arbiter {

class SpeedZone {
 public:
  SpeedZone() = default;  // nowhere
  SpeedZone(const std::optional<config::SceneSlit>& slit, double speed_m_s) : slit_(slit), speed_m_s_(speed_m_s) {}

  // Highest tip speed allowed at a point in the base frame [m/s]; `otherwise` outside the slit.
  double limit_at(const Vec3& tip_m, double otherwise) const {
    return is_inside(tip_m, 0.0) ? std::fmin(otherwise, speed_m_s_) : otherwise;
  }
  // A point in the base frame is inside the slit.
  bool holds(const Vec3& point_m) const { return is_inside(point_m, 0.0); }
  // Speed to ask for at a point: lowered early enough to brake before the mouth, and less than the limit, because the
  // true tip swings about the commanded speed.
  double advice_at(const Vec3& tip_m, double otherwise) const {
    return slows_at(tip_m) ? std::fmin(otherwise, kAskedShare * speed_m_s_) : otherwise;
  }
  // A point where advice_at may be less than it is elsewhere.
  bool slows_at(const Vec3& tip_m) const { return is_inside(tip_m, kBrakingWay_m); }

 private:
  static constexpr double kAskedShare = 0.87;
  static constexpr double kBrakingWay_m = 0.10;  // 0.10 m/s to 0.03 m/s with 0.14 m/s2 and 1 m/s3 takes 0.06 m

  bool is_inside(const Vec3& point_m, double before_m) const {
    if (!slit_) return false;
    const double u = dot(slit_->u_axis, point_m);
    return u >= slit_->mouth_u_m - before_m && u <= slit_->end_u_m &&
           std::fabs(dot(slit_->normal, point_m) - slit_->offset_m) <= slit_->half_gap_m;
  }

  std::optional<config::SceneSlit> slit_;
  double speed_m_s_ = 0.0;
};

}  // namespace liana::arbiter
