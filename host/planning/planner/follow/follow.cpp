#include "host/planning/planner/follow/follow.hpp"

#include <algorithm>
#include <cmath>

#include "host/planning/planner/follow/follow_pose.hpp"
#include "host/planning/planner/problem/plan_rows.hpp"
#include "host/planning/planner/start/goal_poses.hpp"
#include "host/planning/planner/start/relax.hpp"
#include "host/planning/planner/text.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr double kDraw_m2 = 0.01;     // towards the end pose on the way
constexpr double kFedDraw_m2 = 1e-5;  // of an arm that is fed, towards the pose before
constexpr double kStartLine = 0.1;  // what the body's distance counts before the curve's beginning: an arm with a fixed
                                    // base has to take up length there and cannot stay on its line
constexpr double kDirection_m2 = 0.05;      // weight of the tip's direction
constexpr double kFedDirection_m2 = 0.002;  // of an arm that is fed, whose body is to be on the curve
constexpr double kFedFar_m = 0.005;
constexpr double kFedReach_m =
    0.002;  // clearance beyond the margin that is wanted of it: the curve goes where there is room
constexpr double kEndDraw_m2 = 1e-4;  // towards the seed while the end pose is looked for
constexpr double kTurnDraw_m2 = 10.0;
constexpr std::int32_t kEndIterations = 100;
constexpr std::int32_t kPosesPerStep = 12;
constexpr std::int32_t kFedIterations = 60;
constexpr double kSettled_rad = 0.003;
constexpr std::int32_t kTurnSteps = 400;
constexpr double kTurn_rad = 0.01;  // of a theta in each of them
constexpr double kTipTolerance_m = 1e-6;
constexpr double kAtLimit_rad = 1e-9;
constexpr int kLooks = 8;        // at the tip between two waypoints
constexpr int kMaxHalvings = 5;  // of the way between two poses, where the tip swings out or a step is too long

Vec3 tip_of(const Room& room, const ThetaVector& theta) {
  return forward_kinematics(room.table(), theta).tip_in_base.position_m;
}

std::uint32_t held_mask(const PlanRequest& request) {
  std::uint32_t mask = 0;
  for (const HeldPhase& phase : request.held) mask |= 1u << phase.theta;
  return mask;
}

// The arm with its tip at a place on the curve.
struct Stop {
  ThetaVector theta_rad{};
  double along_m = 0.0;
};

class Follower {
 public:
  Follower(const Room& room, const PlanRequest& request, const Curve& curve, const PlanControl& control)
      : room_(room), request_(request), curve_(curve), track_(room, request.from_rad, curve), control_(control) {}

  FollowPath run(const std::optional<ThetaVector>& goal) {
    if (!is_possible()) return out_;
    // An arm that is fed has its length from its slide: every pose follows from the one before.
    const std::optional<ThetaVector> end = goal || is_fed() ? goal : end_pose();
    if (end && tip_off_m(room_, curve_, curve_.length_m(), *end) > kTipTolerance_m) {
      return failed("tip", text("no joint angles within the limits bring the tip to the end of the curve, %s",
                                at(curve_.length_m()).c_str()));
    }
    std::vector<Stop> way{{request_.from_rad, 0.0}};
    if (feed_in(end, way) && (!goal || turn_to(*goal, way))) out_.theta_rad = thinned(refined(way));
    return out_;
  }

 private:
  std::string at(double along_m) const {
    const Vec3 p = curve_.at(along_m).position_m;
    return text("%.3f m along it, at (%.3f, %.3f, %.3f)", along_m, p[0], p[1], p[2]);
  }

  FollowPath failed(const char* constraint, const std::string& reason) {
    out_.constraint = constraint;
    out_.reason = reason;
    return out_;
  }

  // From the base, or from the nearest place to which it can be fed.
  double from_base_m(const Vec3& point_m) const {
    const SegmentParams& base = room_.table().segment[0];
    const double travel_m = is_fed() ? base.slide_m_rad * base.theta_limit_rad : 0.0;
    return norm(subtract(point_m, {std::clamp(point_m[0], -travel_m, travel_m), 0.0, 0.0}));
  }

  bool is_possible() {
    const Vec3 tip = tip_of(room_, request_.from_rad);
    const double off_m = norm(subtract(tip, curve_.at(0.0).position_m)), length_m = arm_length_m(room_.table());
    if (off_m > kFollowStartOff_m) {
      failed("curve",
             text("the curve begins %.1f mm from the tip, which is at (%.4f, %.4f, %.4f); at most %.0f mm are allowed",
                  1000.0 * off_m, tip[0], tip[1], tip[2], 1000.0 * kFollowStartOff_m));
      return false;
    }
    for (double along_m = 0.0; along_m < curve_.length_m() + kFollowStep_m; along_m += kFollowStep_m) {
      const Vec3 here = curve_.at(along_m).position_m;
      const double away_m = from_base_m(here);
      if (away_m > length_m) {
        failed("curve", text("the curve leaves the arm's reach: %.3f m from the base %s; the arm is %.3f m long",
                             away_m, at(along_m).c_str(), length_m));
        return false;
      }
      for (std::int32_t i = 0; i < clearance::obstacle_count(room_.scene()); ++i) {
        const double left_m = clearance::clearance({here, here, room_.link_radius_m()}, room_.scene(), i).distance_m;
        if (left_m >= request_.margin_m) continue;
        failed("curve", text("the curve leaves the tip %.1f mm from '%s' %s; the margin is %.1f mm", 1000.0 * left_m,
                             clearance::obstacle_name(room_.scene(), i).c_str(), at(along_m).c_str(),
                             1000.0 * request_.margin_m));
        return false;
      }
    }
    return true;
  }

  bool is_fed() const { return room_.table().feed_count() > 0; }

  double wanted_clearance_m() const { return request_.margin_m + (is_fed() ? kFedReach_m : kRelaxReach_m); }

  FollowAim aim(double along_m, const ThetaVector& to, double draw, double body = 1.0) const {
    FollowAim out{along_m, to, draw, held_mask(request_), wanted_clearance_m(), body};
    out.start_line = is_fed() ? 1.0 : kStartLine;
    out.direction_m2 = is_fed() ? kFedDirection_m2 : kDirection_m2;
    out.far_m = is_fed() ? kFedFar_m : 0.0;
    return out;
  }

  // From fixed seeds: the pose whose body is nearest to the curve, a free one when there is any.
  ThetaVector end_pose() const {
    ThetaVector best = request_.from_rad;
    double least = 1e301;
    for (std::int32_t seed = 0; seed < kGoalPoseSeeds; ++seed) {
      ThetaVector from = seed_pose(room_.table(), request_.from_rad, seed);
      for (Index k = 0; k < from.size(); ++k) {
        if (((held_mask(request_) >> k) & 1u) != 0) from[k] = request_.from_rad[k];
      }
      const ThetaVector theta =
          follow_pose(room_, track_, aim(curve_.length_m(), from, kEndDraw_m2), from, kEndIterations);
      if (tip_off_m(room_, curve_, curve_.length_m(), theta) > kTipTolerance_m) continue;
      const double cost = misfit_m2(room_, track_, aim(curve_.length_m(), from, kEndDraw_m2), theta) +
                          (room_.look(theta).nearest.distance_m < request_.margin_m ? 1e3 : 0.0);
      if (cost < least) least = cost, best = theta;
    }
    return best;
  }

  // Appends poses with the tip ever farther along the curve; where the arm has to change its shape, several with the
  // tip in one place.
  bool feed_in(const std::optional<ThetaVector>& end, std::vector<Stop>& way) {
    const std::int32_t steps = static_cast<std::int32_t>(std::ceil(curve_.length_m() / kFollowStep_m));
    for (std::int32_t s = 1; s <= steps; ++s) {
      if (control_.cancelled != nullptr && control_.cancelled->load()) return false;
      const double along_m = curve_.length_m() * s / steps;
      if (is_fed()) {
        push_settled(along_m, way);
      } else {
        push_settling(along_m, *end, way);
      }
      if (tip_off_m(room_, curve_, along_m, way.back().theta_rad) < kTipTolerance_m) continue;
      if (slide_is_out(way.back().theta_rad)) return false;
      const clearance::ArmClearance near = room_.look(way.back().theta_rad);
      const bool pushed = near.nearest.distance_m < wanted_clearance_m();
      const std::string what =
          pushed ? "'" + clearance::obstacle_name(room_.scene(), near.obstacle) + "'" : "the limits of the joints";
      failed(pushed ? "clearance" : "tip", text("%s keep the tip off the curve %s", what.c_str(), at(along_m).c_str()));
      return false;
    }
    return true;
  }

  // An arm that is fed is best near where it was, and only the best pose counts: those on the way to it would have it
  // swing about the curve.
  void push_settled(double along_m, std::vector<Stop>& way) const {
    const ThetaVector& before = way.back().theta_rad;
    way.push_back({follow_pose(room_, track_, aim(along_m, before, kFedDraw_m2), before, kFedIterations), along_m});
  }

  void push_settling(double along_m, const ThetaVector& end, std::vector<Stop>& way) const {
    for (std::int32_t i = 0; i < kPosesPerStep; ++i) {
      const ThetaVector before = way.back().theta_rad;
      way.push_back({follow_pose(room_, track_, aim(along_m, end, kDraw_m2), before, 1), along_m});
      if (largest_change(way.back().theta_rad, before) < kSettled_rad) break;
    }
  }

  // Whether the slide that feeds stands at its front end; that is then what failed.
  bool slide_is_out(const ThetaVector& theta_rad) {
    const SegmentParams& base = room_.table().segment[0];
    if (!is_fed() || theta_rad[0] < base.theta_limit_rad - kAtLimit_rad) return false;
    failed("curve",
           text("the slide has %.3f m of travel left at the start and the curve is %.3f m long; start with the "
                "slide farther back, or shorten the curve",
                base.slide_m_rad * (base.theta_limit_rad - request_.from_rad[0]), curve_.length_m()));
    return true;
  }

  // The tip stays at the end of the curve while the arm takes the shape wanted there.
  bool turn_to(const ThetaVector& end, std::vector<Stop>& way) {
    for (std::int32_t i = 0; i < kTurnSteps && way.back().theta_rad != end; ++i) {
      const double left = largest_change(way.back().theta_rad, end);
      const ThetaVector next = left < kTurn_rad ? end : between(way.back().theta_rad, end, kTurn_rad / left);
      const FollowAim there = aim(curve_.length_m(), next, kTurnDraw_m2, 0.0);
      way.push_back({next == end ? end : follow_pose(room_, track_, there, next, 1), curve_.length_m()});
    }
    if (way.back().theta_rad == end) return true;
    failed("goal", "the arm cannot get from the shape in which it followed into that of the goal");
    return false;
  }

  // Steps of the request and, between the two, the tip within kFollowTipOff_m of their part of the curve and on a way
  // as long: a part that turns back is not cut off.
  bool suffices(const Stop& a, const Stop& b) const {
    if (!steps_hold(request_, {a.theta_rad, b.theta_rad})) return false;
    double way_m = 0.0;
    Vec3 before = tip_of(room_, a.theta_rad);
    for (int i = 1; i <= kLooks; ++i) {
      const Vec3 tip = tip_of(room_, between(a.theta_rad, b.theta_rad, static_cast<double>(i) / kLooks));
      way_m += norm(subtract(tip, before));
      before = tip;
      if (norm(subtract(tip, curve_.nearest(tip, a.along_m, b.along_m).position_m)) > kFollowTipOff_m) return false;
    }
    return way_m + 2.0 * kFollowTipOff_m > b.along_m - a.along_m;
  }

  // Appends the way from the last pose to `to`, with poses between where the two alone do not suffice.
  void go_to(const Stop& to, int halvings, std::vector<Stop>& way) const {
    const Stop from = way.back();
    if (halvings > 0 && !suffices(from, to)) {
      const ThetaVector half = between(from.theta_rad, to.theta_rad, 0.5);
      const double along_m = 0.5 * (from.along_m + to.along_m);
      go_to({follow_pose(room_, track_, aim(along_m, half, 0.0), half, 0), along_m}, halvings - 1, way);
      go_to(to, halvings - 1, way);
    } else {
      way.push_back(to);
    }
  }

  std::vector<Stop> refined(const std::vector<Stop>& way) const {
    std::vector<Stop> out{way.front()};
    for (Index i = 1; i < way.size(); ++i) go_to(way[i], kMaxHalvings, out);
    return out;
  }

  // As few of the poses as suffice.
  Path thinned(const std::vector<Stop>& way) const {
    Path out{way.front().theta_rad};
    Index last = 0;
    for (Index i = 1; i < way.size(); ++i) {
      if (i + 1 < way.size() && suffices(way[last], way[i + 1])) continue;
      out.push_back(way[i].theta_rad);
      last = i;
    }
    return out;
  }

  const Room& room_;
  const PlanRequest& request_;
  const Curve& curve_;
  const FollowTrack track_;
  const PlanControl& control_;
  FollowPath out_;
};

}  // namespace

FollowPath follow_path(const Room& room, const PlanRequest& request, const Curve& curve,
                       const std::optional<ThetaVector>& goal_rad, const PlanControl& control) {
  return Follower(room, request, curve, control).run(goal_rad);
}

FollowCurve slit_curve(const Room& room, const ThetaVector& from_rad, const ThetaVector& goal_rad) {
  if (!room.scene().slit) return {{}, text("the scene '%s' has no slit", room.scene().name.c_str())};
  const config::SceneSlit& slit = *room.scene().slit;
  const auto depth_m = [&](const Vec3& p) { return dot(slit.u_axis, p) - slit.mouth_u_m; };
  const LinkPoints line = link_points(room.table(), goal_rad);
  Index first = Index(line.count) - 1;
  const Vec3 end = line.point_in_base[first];
  if (depth_m(end) <= 0.0 || std::fabs(dot(slit.normal, end) - slit.offset_m) >= slit.half_gap_m) {
    return {{}, text("the goal's tip (%.3f, %.3f, %.3f) is not inside the slit", end[0], end[1], end[2])};
  }
  while (first > 1 && depth_m(line.point_in_base[first - 1]) > 0.0) --first;  // the axis from here on is inside
  const Pose tip = forward_kinematics(room.table(), from_rad).tip_in_base;
  const Vec3 mouth = line.point_in_base[first - 1];
  const Vec3 in = subtract(line.point_in_base[first], mouth), out = rotate(tip.quaternion, {1, 0, 0});
  const double chord_m = norm(subtract(mouth, tip.position_m));
  const Vec3 slope = scale(in, chord_m / norm(in));
  FollowCurve curve{{tip.position_m}, {}};
  constexpr int kPieces = 20;
  for (int i = 1; i < kPieces && chord_m > 0.1; ++i) {
    const double t = static_cast<double>(i) / kPieces, u = 1.0 - t;
    const Vec3 ends = add(scale(tip.position_m, u * u * (1.0 + 2.0 * t)), scale(mouth, t * t * (3.0 - 2.0 * t)));
    curve.points_m.push_back(add(ends, scale(subtract(scale(out, u * chord_m), scale(slope, t)), t * u)));
  }
  for (Index i = first - 1; i < Index(line.count); ++i) curve.points_m.push_back(line.point_in_base[i]);
  return curve;
}

}  // namespace liana::planner
