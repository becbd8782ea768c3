#include "host/control/arbiter/path_timing.hpp"

#include <algorithm>
#include <cmath>

#include "host/control/arbiter/cable_traits.hpp"
#include "host/control/arbiter/serial_traits.hpp"
#include "host/control/timing/trajectory_timing.hpp"

namespace liana::arbiter {

namespace {

constexpr double kGrid_rad = 0.002;  // places looked at on straight pieces; the tip moves by at most 20 mm in between
constexpr double kUnbounded = 1e300;
constexpr double kNoWay_rad = 1e-12;  // between two corners that meet
constexpr int kCornerPlaces = 8;      // and in a corner
constexpr double kBend = 0.75;        // of turn / half (rounded_path.hpp)
constexpr double kCornerShare = 0.7;  // of the acceleration, for going round a corner; the rest for changing pace in it
constexpr double kSmoothing_s = 0.5;  // of each of two means over time
constexpr int kMaxSlowdownRounds = 20;  // of slowing down; two or three are needed
constexpr std::size_t kLookEvery = 5;   // intervals, for what needs kinematics

// Shortest time [s] from a to b, neighbours on the path, by everything that bounds a speed.
template <class Arm>
double shortest_s(const typename Arm::Table& table, const SpeedZone& zone, const Joints<Arm>& a, const Joints<Arm>& b,
                  double rate_rad_s) {
  using Kind = ArmTraits<Arm>;
  double time_s = Kind::drive_time_s(table, a, b);
  for (std::size_t i = 0; i < Kind::joint_count(table); ++i)
    time_s = std::max(time_s, std::fabs(b[i] - a[i]) / std::min(rate_rad_s, Kind::rate_rad_s(table, i)));
  const TipBounds bounds = Kind::tip_bounds(table);
  const Pose from = Kind::tip_at(table, a), to = Kind::tip_at(table, b);
  const double way_m = norm(subtract(to.position_m, from.position_m));
  const double turn_rad = norm(rotation_vector(multiply(to.quaternion, conjugate(from.quaternion))));
  const double speed_m_s = std::min(zone.advice_at(from.position_m, bounds.linear.speed),
                                    zone.advice_at(to.position_m, bounds.linear.speed));
  return std::max({time_s, way_m / speed_m_s, turn_rad / bounds.angular.speed}) / motion::kMoveShare;
}

// Pace [rad/s] along the way at places of it; between them its square changes evenly, so acceleration is constant.
struct Pace {
  std::vector<double> along_rad{0.0};
  std::vector<double> pace_rad_s{};
};

// A short piece of the way, straight or in a corner.
template <class Arm>
struct Piece {
  double from_rad = 0.0, to_rad = 0.0;
  const typename BlendedPath<Arm>::Corner* corner = nullptr;
};

template <class Arm>
std::vector<Piece<Arm>> pieces_of(const BlendedPath<Arm>& path) {
  std::vector<Piece<Arm>> out;
  double from_rad = 0.0;
  const auto go_to = [&](double to_rad, int count, const typename BlendedPath<Arm>::Corner* corner) {
    const double way_rad = (to_rad - from_rad) / count;
    for (int i = 0; i < count && way_rad > kNoWay_rad; ++i)
      out.push_back({from_rad + i * way_rad, from_rad + (i + 1) * way_rad, corner});
    from_rad = to_rad;
  };
  const auto straight_to = [&](double to_rad) {
    go_to(to_rad, std::max(2, static_cast<int>(std::ceil((to_rad - from_rad) / kGrid_rad))), nullptr);
  };
  for (const auto& corner : path.corners()) {
    straight_to(corner.along_rad - corner.half_rad);
    go_to(corner.along_rad + corner.half_rad, kCornerPlaces, &corner);
  }
  straight_to(path.length_rad());
  return out;
}

// Square of the pace at which going round a corner takes all acceleration there is.
template <class Arm>
double corner_pace2(const typename Arm::Table& table, const typename BlendedPath<Arm>::Corner& corner) {
  double pace2 = kUnbounded;
  for (std::size_t i = 0; i < ArmTraits<Arm>::joint_count(table); ++i) {
    const double bend = kBend * std::fabs(corner.turn[i]) / corner.half_rad;
    if (bend > 0.0) pace2 = std::min(pace2, ArmTraits<Arm>::move_accel_rad_s2(table, i) / bend);
  }
  return pace2;
}

// Highest square of the pace on a piece, and by how much it may change there.
struct PieceBound {
  double pace2;
  double gain = kUnbounded;
};

template <class Arm>
PieceBound bound_of(const typename Arm::Table& table, const Piece<Arm>& piece, const Joints<Arm>& from,
                    const Joints<Arm>& to, double time_s) {
  const double way_rad = piece.to_rad - piece.from_rad;
  PieceBound out{way_rad * way_rad / (time_s * time_s)};
  double share = 1.0;  // of the acceleration, for changing the pace
  if (piece.corner != nullptr) {
    const double most2 = corner_pace2<Arm>(table, *piece.corner);
    out.pace2 = std::min(out.pace2, kCornerShare * most2);
    share = 1.0 - out.pace2 / most2;
  }
  for (std::size_t i = 0; i < ArmTraits<Arm>::joint_count(table); ++i) {
    const double change_rad = std::fabs(to[i] - from[i]);
    if (change_rad == 0.0) continue;
    const double accel = share * ArmTraits<Arm>::move_accel_rad_s2(table, i) * way_rad / change_rad;
    out.gain = std::min(out.gain, 2.0 * accel * way_rad);
  }
  return out;
}

// Bounds at every place, then forwards no faster than acceleration allows from rest, and backwards from the end.
template <class Arm>
Pace fastest_pace(const typename Arm::Table& table, const SpeedZone& zone, const BlendedPath<Arm>& path,
                  double rate_rad_s) {
  Pace out;
  std::vector<double> pace2{0.0}, gain;
  Joints<Arm> before = path.at(0.0);
  for (const Piece<Arm>& piece : pieces_of(path)) {
    const Joints<Arm> here = path.at(piece.to_rad);
    const double time_s = shortest_s<Arm>(table, zone, before, here, rate_rad_s);
    const PieceBound bound = bound_of<Arm>(table, piece, before, here, time_s);
    pace2.back() = std::min(pace2.back(), bound.pace2);
    pace2.push_back(bound.pace2);
    gain.push_back(bound.gain);
    out.along_rad.push_back(piece.to_rad);
    before = here;
  }
  pace2.back() = 0.0;
  for (std::size_t k = 0; k < gain.size(); ++k) pace2[k + 1] = std::min(pace2[k + 1], pace2[k] + gain[k]);
  for (std::size_t k = gain.size(); k-- > 0;) pace2[k] = std::min(pace2[k], pace2[k + 1] + gain[k]);
  for (const double square : pace2) out.pace_rad_s.push_back(std::sqrt(square));
  return out;
}

// Places at even times.
std::vector<double> sampled(const Pace& pace, double step_s) {
  std::vector<double> out;
  double begin_s = 0.0;
  for (std::size_t k = 0; k + 1 < pace.along_rad.size(); ++k) {
    const double way_rad = pace.along_rad[k + 1] - pace.along_rad[k];
    const double from = pace.pace_rad_s[k], to = pace.pace_rad_s[k + 1];
    const double time_s = 2.0 * way_rad / (from + to), accel = (to - from) / time_s;
    while (true) {
      const double t = static_cast<double>(out.size() + 1) * step_s - begin_s;
      if (t >= time_s) break;
      out.push_back(pace.along_rad[k] + t * (from + 0.5 * accel * t));
    }
    begin_s += time_s;
  }
  out.push_back(pace.along_rad.back());
  return out;
}

// Mean over `width` neighbours, with rest before the start and after the end.
std::vector<double> smoothed(const std::vector<double>& in, std::size_t width) {
  std::vector<double> padded(width, 0.0), out;
  padded.insert(padded.end(), in.begin(), in.end());
  padded.insert(padded.end(), width, in.back());
  double sum = 0.0;
  for (std::size_t k = 0; k < padded.size(); ++k) {
    sum += padded[k];
    if (k < width) continue;
    sum -= padded[k - width];
    out.push_back(sum / static_cast<double>(width));
  }
  out.back() = in.back();  // exactly, whatever rounding the sum has gathered
  return out;
}

// How many times too fast the motion is for the limit it passes most.
template <class Arm>
double excess(const typename Arm::Table& table, const SpeedZone& zone, const BlendedPath<Arm>& path, double rate_rad_s,
              const std::vector<double>& along) {
  using Kind = ArmTraits<Arm>;
  const double step_s = interval_s(table);
  double most = 0.0;
  Joints<Arm> before = path.at(0.0), last = before, looked = before;
  for (std::size_t k = 0; k < along.size(); ++k) {
    const Joints<Arm> here = path.at(along[k]);
    for (std::size_t i = 0; i < Kind::joint_count(table); ++i) {
      const double accel = std::fabs(here[i] - 2.0 * last[i] + before[i]) / (step_s * step_s);
      most = std::max(most, std::sqrt(accel / Kind::move_accel_rad_s2(table, i)));
    }
    if ((k + 1) % kLookEvery == 0) {
      most = std::max(most, shortest_s<Arm>(table, zone, looked, here, rate_rad_s) / (kLookEvery * step_s));
      looked = here;
    }
    before = last;
    last = here;
  }
  return most;
}

}  // namespace

template <class Arm>
std::vector<double> path_timing(const typename Arm::Table& table, const SpeedZone& zone, const BlendedPath<Arm>& path,
                                double rate_rad_s) {
  if (path.length_rad() == 0.0) return {0.0};
  const Pace pace = fastest_pace<Arm>(table, zone, path, rate_rad_s);
  const auto width = static_cast<std::size_t>(std::ceil(kSmoothing_s / interval_s(table)));
  double slower = 1.0;
  std::vector<double> along;
  for (int round = 0; round < kMaxSlowdownRounds; ++round) {
    along = smoothed(smoothed(sampled(pace, interval_s(table) / slower), width), width);
    const double much = excess<Arm>(table, zone, path, rate_rad_s, along);
    if (much <= 1.0) break;
    slower *= 1.001 * much;
  }
  return along;
}

template std::vector<double> path_timing<cable::CableArm>(const cable::RobotParams&, const SpeedZone&,
                                                          const BlendedPath<cable::CableArm>&, double);
template std::vector<double> path_timing<serial::SerialArm>(const serial::RobotParams&, const SpeedZone&,
                                                            const BlendedPath<serial::SerialArm>&, double);

}  // namespace liana::arbiter
