#include "host/operator/station/lag_meter.hpp"

#include <algorithm>
#include <cmath>

namespace liana::station {
namespace {

constexpr double kWindow_s = 2.0;
constexpr double kMost_s = 4.0;
constexpr double kStep_s = 0.01;
constexpr double kMoved_m = 0.010;  // of the tip's way, that the hand asks for in a window
constexpr double kExplained = 0.2;

}  // namespace

void LagMeter::hand(double t_s, bool held, const Vec3& position_m, double scale_factor) {
  if (held && !held_) {
    hand_.clear();
    hand_from_m_ = position_m;
  }
  held_ = held;
  if (held) hand_.push_back({t_s, scale(subtract(position_m, hand_from_m_), scale_factor)});
}

void LagMeter::arm(double t_s, bool engaged, const Vec3& commanded_m, const Vec3& measured_m) {
  if (engaged && !engaged_) {
    commanded_.clear();
    measured_.clear();
    commanded_from_m_ = commanded_m;
    measured_from_m_ = measured_m;
    window_from_s_ = t_s;
  }
  engaged_ = engaged;
  if (!engaged) return;
  commanded_.push_back({t_s, subtract(commanded_m, commanded_from_m_)});
  measured_.push_back({t_s, subtract(measured_m, measured_from_m_)});
  if (t_s - window_from_s_ >= kWindow_s) close_window(t_s);
}

void LagMeter::close_window(double t_s) {
  const double asked_m = norm(subtract(way_at(hand_, t_s), way_at(hand_, window_from_s_)));
  const auto commanded = asked_m > kMoved_m ? lag_of(commanded_, window_from_s_) : std::nullopt;
  const auto measured = asked_m > kMoved_m ? lag_of(measured_, window_from_s_) : std::nullopt;
  if (commanded) commanded_lags_s_.push_back(*commanded);
  if (measured) measured_lags_s_.push_back(*measured);
  window_from_s_ = t_s;
}

LagMeter::Way::const_iterator LagMeter::first_from(const Way& way, double t_s) {
  return std::lower_bound(way.begin(), way.end(), t_s, [](const Place& p, double t) { return p.t_s < t; });
}

// Nothing was asked for before the grip.
Vec3 LagMeter::way_at(const Way& way, double t_s) {
  const auto after = first_from(way, t_s);
  if (after == way.end()) return way.empty() ? Vec3{} : way.back().way_m;
  if (after == way.begin()) return {};
  const Place& before = *(after - 1);
  const double share = (t_s - before.t_s) / (after->t_s - before.t_s);
  return add(before.way_m, scale(subtract(after->way_m, before.way_m), share));
}

std::optional<double> LagMeter::lag_of(const Way& tip, double from_s) const {
  double least = 1e9, best_s = 0.0, moved = 0.0;
  const auto first = first_from(tip, from_s);
  for (double lag_s = 0.0; lag_s <= kMost_s; lag_s += kStep_s) {
    double sum = 0.0, way = 0.0;
    const Vec3 begin = way_at(hand_, from_s - lag_s);
    for (auto place = first; place != tip.end(); ++place) {
      const Vec3 asked = way_at(hand_, place->t_s - lag_s), off = subtract(place->way_m, asked);
      const Vec3 gone = subtract(asked, begin);
      sum += dot(off, off);
      way += dot(gone, gone);
    }
    if (sum >= least) continue;
    least = sum, best_s = lag_s, moved = way;
  }
  const bool explained = moved > 0.0 && least <= kExplained * kExplained * moved;
  return explained ? std::optional(best_s) : std::nullopt;
}

LagStatistics LagMeter::figures_of(std::vector<double> lags_s) {
  if (lags_s.empty()) return {};
  std::sort(lags_s.begin(), lags_s.end());
  return {lags_s[lags_s.size() / 2], lags_s.back()};
}

}  // namespace liana::station
