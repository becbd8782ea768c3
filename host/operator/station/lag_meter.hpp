// How far the tip is behind the hand: the delay that best explains the tip's way by the hand's.
//
// Both ways are counted from where the arm began to follow. Of every window of 2 s in which the hand moved, the lag is
// the one of 0 to 4 s at which |tip(t) - scale x hand(t - lag)| is least in the mean square; a window that no lag
// explains to a fifth of the hand's way (the arm was slowed down, or held) tells none.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::station {

// In seconds; nothing where no window told.
struct LagStatistics {
  std::optional<double> median_s;
  std::optional<double> worst_s;
};

class LagMeter {
 public:
  // The hand at `t_s`, by the stamp of its sample; `held`: the arm shall follow. `scale`: the tip's way for one of the
  // hand. Times rise.
  void hand(double t_s, bool held, const Vec3& position_m, double scale);
  // The arm at `t_s`.
  void arm(double t_s, bool engaged, const Vec3& commanded_m, const Vec3& measured_m);

  LagStatistics commanded() const { return figures_of(commanded_lags_s_); }
  LagStatistics measured() const { return figures_of(measured_lags_s_); }

 private:
  struct Place {
    double t_s = 0.0;
    Vec3 way_m{};  // since the arm began to follow
  };
  using Way = std::vector<Place>;

  static LagStatistics figures_of(std::vector<double> lags_s);
  static Way::const_iterator first_from(const Way& way, double t_s);
  static Vec3 way_at(const Way& way, double t_s);
  std::optional<double> lag_of(const Way& tip, double from_s) const;
  void close_window(double t_s);

  Way hand_;  // of this grip
  Way commanded_, measured_;
  Vec3 hand_from_m_{}, commanded_from_m_{}, measured_from_m_{};
  double window_from_s_ = 0.0;
  bool held_ = false, engaged_ = false;
  std::vector<double> commanded_lags_s_, measured_lags_s_;
};

}  // namespace liana::station
