#include "host/planning/planner/follow/follow_statistics.hpp"

#include <algorithm>

#include "host/planning/planner/check/plan_check.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr int kFigureLooks = 4;  // per interval

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

}  // namespace

FollowStatistics follow_figures(const RobotParams& table, const std::vector<ThetaVector>& path, const Curve& curve) {
  FollowStatistics out;
  out.curve_length_m = curve.length_m();
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
