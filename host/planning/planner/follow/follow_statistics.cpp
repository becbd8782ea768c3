#include "host/planning/planner/follow/follow_statistics.hpp"

#include <algorithm>

#include "host/planning/planner/check/plan_check.hpp"
#include "host/planning/planner/follow/follow_track.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr int kFigureLooks = 4;  // per interval
constexpr int kLinkLooks = 4;    // per link

// The arm's line at the start and the way of the tip since, as straight pieces.
class TipPath {
 public:
  explicit TipPath(const std::vector<Vec3>& start_line_m) : point_m_(start_line_m) {}

  void go_to(const Vec3& tip_m) { point_m_.push_back(tip_m); }

  double distance_m(const Vec3& p) const {
    double least_m = 1e300;
    for (Index i = 0; i + 1 < point_m_.size(); ++i) {
      const Vec3 piece = subtract(point_m_[i + 1], point_m_[i]), away = subtract(p, point_m_[i]);
      const double square = dot(piece, piece);
      const double share = square > 0.0 ? std::clamp(dot(away, piece) / square, 0.0, 1.0) : 0.0;
      least_m = std::min(least_m, norm(subtract(away, scale(piece, share))));
    }
    return least_m;
  }

 private:
  std::vector<Vec3> point_m_;
};

// The arm's line at the start and the curve after it.
class Track {
 public:
  Track(const RobotParams& table, const ThetaVector& start_rad, const Curve& curve)
      : line_(line_of(table, start_rad)), curve_(curve) {}

  // Nearest to a point, not beyond the tip; along_m is below 0 before the curve's beginning.
  CurvePlace nearest(const Vec3& point_m, double tip_along_m) const {
    CurvePlace before = line_.nearest(point_m, 0.0, line_.length_m());
    before.along_m -= line_.length_m();
    const CurvePlace after = curve_.nearest(point_m, 0.0, tip_along_m);
    return norm(subtract(point_m, after.position_m)) < norm(subtract(point_m, before.position_m)) ? after : before;
  }

 private:
  static Curve line_of(const RobotParams& table, const ThetaVector& start_rad) {
    std::vector<Vec3> line = feed_line(table, start_rad);
    const std::vector<Vec3> axis = plain_axis(table, start_rad);
    line.insert(line.end(), axis.begin(), axis.end());
    return Curve(line);
  }

  Curve line_;
  const Curve& curve_;
};

// Segment (from 1) of a link (from 1).
std::int32_t segment_of(const RobotParams& table, std::int32_t link) {
  std::int32_t segment = 0;
  while (link > 0) link -= table.segment[Index(segment++)].modules;
  return segment;
}

void look_at_curve(const RobotParams& table, const Track& track, const std::vector<Vec3>& end_m, double tip_along_m,
                   FollowStatistics& out) {
  for (Index i = 0; i < kLinkLooks * (end_m.size() - 1); ++i) {
    const Index link = i / kLinkLooks;
    const double share = static_cast<double>(i % kLinkLooks) / kLinkLooks;
    const Vec3 here = add(scale(end_m[link], 1.0 - share), scale(end_m[link + 1], share));
    const CurvePlace on = track.nearest(here, tip_along_m);
    const double off_m = norm(subtract(here, on.position_m));
    if (off_m <= out.curve_off_m) continue;
    out.curve_off_m = off_m;
    out.curve_off_segment = segment_of(table, static_cast<std::int32_t>(link) + 1);
    out.curve_off_along_m = on.along_m;
    out.curve_off_tip_along_m = tip_along_m;
  }
}

}  // namespace

FollowStatistics follow_figures(const RobotParams& table, const std::vector<ThetaVector>& path, const Curve& curve) {
  FollowStatistics out;
  out.curve_length_m = curve.length_m();
  const Track track(table, path.front(), curve);
  TipPath tip_path(plain_axis(table, path.front()));
  double sum_m = 0.0;
  std::int64_t asked = 0;
  for (Index i = 1; i <= kFigureLooks * (path.size() - 1); ++i) {
    const Index w = (i - 1) / kFigureLooks;
    const double share = static_cast<double>(i - kFigureLooks * w) / kFigureLooks;
    ThetaVector theta{};
    for (Index k = 0; k < theta.size(); ++k) theta[k] = (1.0 - share) * path[w][k] + share * path[w + 1][k];
    const std::vector<Vec3> end_m = plain_axis(table, theta);
    tip_path.go_to(end_m.back());
    const CurvePlace tip = curve.nearest(end_m.back(), 0.0, curve.length_m());
    out.tip_off_m = std::max(out.tip_off_m, norm(subtract(end_m.back(), tip.position_m)));
    look_at_curve(table, track, end_m, tip.along_m, out);
    for (Index link = end_m.size() - 1; link-- > 1;) {
      const double off_m = tip_path.distance_m(end_m[link]);
      sum_m += off_m;
      ++asked;
      if (off_m <= out.body_off_m) continue;
      out.body_off_m = off_m;
      out.worst_link = static_cast<std::int32_t>(link);
      out.worst_tip_along_m = tip.along_m;
    }
  }
  if (asked > 0) out.mean_body_off_m = sum_m / static_cast<double>(asked);
  return out;
}

}  // namespace liana::planner
