// A hand's goals through a plane that comes and goes, without a step: what the plane's coming or going would change at
// once is kept as a bump, which bleeds away.
#pragma once

#include <optional>

#include "host/control/virtual_fixtures/guide_plane.hpp"

namespace liana::virtual_fixtures {

// How fast a bump bleeds away at most, what that speed rises by in a second, and how slowly it ends. A tip that is led
// aside by 5 mm/s from one interval to the next swings beyond its speed in the slit.
struct Bleed {
  double most = 0.0;   // a second
  double least = 0.0;  // a second
};
constexpr Bleed kBleed_m{0.003, 1e-4};
constexpr Bleed kBleed_rad{0.0087, 3e-4};  // 0.5 deg/s

class Guide {
 public:
  // The goal of this command interval, of `dt_s`: in the plane where there is one, plus what is left of the bump. The
  // first one after stop() is `goal` itself, less what may bleed in one interval.
  Pose next(const Pose& goal, const std::optional<GuidePlane>& plane, double dt_s);
  // Nobody steers: what comes next begins anew.
  void stop();
  // What is left of the bump [m, rad].
  double bump_m() const { return norm(bump_m_); }
  double bump_rad() const { return norm(bump_rad_); }

 private:
  Pose wanted(const Pose& goal) const { return plane_ ? in_plane(*plane_, goal) : goal; }
  Pose bumped(const Pose& goal) const;

  std::optional<GuidePlane> plane_;
  Vec3 bump_m_{}, bump_rad_{};                    // base frame: added to what is wanted
  double bleeds_m_s_ = 0.0, bleeds_rad_s_ = 0.0;  // now
};

}  // namespace liana::virtual_fixtures
