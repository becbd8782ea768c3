// The verified clearance: the arm as it is believed to be against the scene as it is believed to stand, less a bound of
// what may be wrong with either, link by link.
#pragma once

#include <array>
#include <cstdint>

#include "host/control/clearance_bound/registration.hpp"
#include "host/model/clearance/clearance.hpp"

namespace liana::clearance_bound {

// How the bound is made.
struct BoundRule {
  double sigmas = 3.5;         // of the registration's own uncertainty of link against body, along the way out
  double constant_m = 1.5e-3;  // beside it: links between their joints, and what of friction is faster than pictures
  double ahead_s = 0.025;      // and what a link approaches in this time: until the next claim, and a tick
};

struct VerifiedClearance {
  double distance_m = clearance::kNoObstacle_m;  // lower bound of the true distance; negative: contact is possible
  double bound_m = 0.0;                          // what was taken off the distance that was found
  std::int32_t link = -1;                        // 0-based; -1: the scene is empty
  std::int32_t obstacle = -1;                    // clearance::obstacle_name
  Vec3 where_m{};                                // on the link's axis, base frame
  double uncertain_m = 0.0;                      // of the bound: what arm and registration may be wrong by,
  double allowance_m = 0.0;  // and what the body may stand beside its drawing; the rest is what the link approaches
};

// Of all links that may soon be the nearest the largest parts of their bounds.
struct NearLinks {
  double uncertain_m = 0.0, allowance_m = 0.0;
};

// What is known of the scene now.
struct KnownScene {
  const Registration& registration;
  bool has_seen = false;  // a picture was taken in: bodies are where the registration says; else where they are drawn,
  double shift_m = 0.0;   // and may stand so far beside that
  double turn_rad = 0.0;  // and be turned by so much about the slit frame's origin
};

class ClearanceFinder {
 public:
  ClearanceFinder(const RobotParams& table, double radius_m, const config::SceneConfig& scene,
                  const BoundRule& rule = {});

  // Least over every link and body. 40 links, 15 cables, 3 bodies: about 60 us. Nothing is allocated.
  VerifiedClearance find(const MeasuredArm& arm, const KnownScene& known);
  // Of the last find: the arm's angles as they are believed to be, and the links whose claim is at most kSoon_m above
  // the least.
  const ThetaVector& believed_rad() const { return believed_rad_; }
  const NearLinks& near_links() const { return near_links_; }

 private:
  static constexpr double kSoon_m = 0.05;  // a tip at its speed in the slit goes this far in two seconds

  static constexpr std::size_t kPoints = kMaxSegments * kMaxModules + 1;
  // What links do with errors and time, at every joint centre: [point], [point][cable].
  struct Motion {
    LinkPoints points, in_drawing;
    std::array<Vec3, kPoints> velocity_m_s;
    std::array<std::array<Vec3, kMaxCables>, kPoints> by_length;
  };

  void move(const MeasuredArm& arm, const KnownScene& known);
  VerifiedClearance judged(const clearance::Clearance& found, std::int32_t link, std::int32_t obstacle,
                           const KnownScene& known) const;

  RobotParams table_;
  CableLayout layout_;
  double radius_m_;
  config::SceneConfig scene_;
  BoundRule rule_;
  Motion motion_{};
  ThetaVector believed_rad_{};
  NearLinks near_links_;
};

}  // namespace liana::clearance_bound
