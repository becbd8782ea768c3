// A path through points of an arm, as a curve without corners: straight in the joints from point to point, and at each
// point turned into the next direction so that no place of the arm leaves the straight pieces by more than kPathOff_m.
//
// Around a point the direction goes from d1 to d2 as d1 + (d2 - d1) (3 x^2 - 2 x^3), x = 0..1 over 2 h of the way. The
// curve then passes 0.1875 h (d2 - d1) beside the point and bends by at most 0.75 (d2 - d1) / h.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/control/arbiter/arm_traits.hpp"

namespace liana::arbiter {

constexpr double kPathOff_m = 0.001;

template <class Arm>
class BlendedPath {
 public:
  using Kind = ArmTraits<Arm>;
  using Table = typename Arm::Table;
  using Vector = Joints<Arm>;

  // Where the direction turns, and how far before and behind it does; 0 where it hardly does.
  struct Corner {
    double along_rad = 0.0;
    double half_rad = 0.0;
    Vector turn{};  // d2 - d1
  };

  // Points that follow each other at the same place count once. Cost: two forward kinematics a point.
  BlendedPath(const Table& table, const std::vector<Vector>& points_rad) : point_rad_{points_rad.front()} {
    for (const Vector& point : points_rad) add_point(point);
    for (std::size_t k = 0; k + 1 < direction_.size(); ++k) corner_.push_back(round(table, k));
  }

  // The way [rad]: the lengths of the pieces together, each the root of the sum of squares over the joints.
  double length_rad() const { return along_rad_.back(); }
  const std::vector<Corner>& corners() const { return corner_; }

  // Joints at a place on the way (clamped).
  Vector at(double along_rad) const {
    if (direction_.empty() || along_rad <= 0.0) return point_rad_.front();
    if (along_rad >= length_rad()) return point_rad_.back();
    const auto after = std::upper_bound(along_rad_.begin(), along_rad_.end(), along_rad);
    const auto piece = static_cast<std::size_t>(after - along_rad_.begin()) - 1;
    if (piece > 0 && along_rad < along_rad_[piece] + corner_[piece - 1].half_rad) return turned(piece - 1, along_rad);
    if (piece < corner_.size() && along_rad > along_rad_[piece + 1] - corner_[piece].half_rad)
      return turned(piece, along_rad);
    return moved(point_rad_[piece], direction_[piece], along_rad - along_rad_[piece]);
  }

 private:
  static constexpr double kBeside = 0.1875;  // of half_rad, times the turn
  static constexpr double kSame_rad = 1e-9;
  static constexpr double kNoTurn = 2e-5;     // of points on one line: nothing to round
  static constexpr double kProbe_rad = 1e-4;  // to see how far the arm goes for a turn

  static Vector moved(const Vector& from, const Vector& direction, double way) {
    Vector out{};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = from[i] + way * direction[i];
    return out;
  }

  void add_point(const Vector& point) {
    Vector way = moved(point, point_rad_.back(), -1.0);
    double square = 0.0;
    for (const double change : way) square += change * change;
    const double length_rad = std::sqrt(square);
    if (length_rad < kSame_rad) return;
    for (double& change : way) change /= length_rad;
    direction_.push_back(way);
    along_rad_.push_back(along_rad_.back() + length_rad);
    point_rad_.push_back(point);
  }

  // Between pieces k and k + 1.
  Corner round(const Table& table, std::size_t k) const {
    Corner corner{along_rad_[k + 1], 0.0, moved(direction_[k + 1], direction_[k], -1.0)};
    const Vector& point = point_rad_[k + 1];
    const double apart_m = Kind::apart_m(table, point, moved(point, corner.turn, kProbe_rad)) / kProbe_rad;
    const auto is_small = [](double turn) { return std::fabs(turn) < kNoTurn; };
    if (std::all_of(corner.turn.begin(), corner.turn.end(), is_small)) return corner;
    const double shorter_rad = std::min(along_rad_[k + 1] - along_rad_[k], along_rad_[k + 2] - along_rad_[k + 1]);
    corner.half_rad = 0.5 * shorter_rad;
    if (kBeside * corner.half_rad * apart_m > kPathOff_m) corner.half_rad = kPathOff_m / (kBeside * apart_m);
    return corner;
  }

  Vector turned(std::size_t k, double along_rad) const {
    const Corner& corner = corner_[k];
    const double x = (along_rad - corner.along_rad + corner.half_rad) / (2.0 * corner.half_rad);
    const Vector straight = moved(point_rad_[k + 1], direction_[k], along_rad - corner.along_rad);
    return moved(straight, corner.turn, 2.0 * corner.half_rad * x * x * x * (1.0 - 0.5 * x));
  }

  std::vector<Vector> point_rad_;
  std::vector<Vector> direction_;       // of each piece, of length 1
  std::vector<double> along_rad_{0.0};  // of each point
  std::vector<Corner> corner_;          // between the pieces
};

}  // namespace liana::arbiter
