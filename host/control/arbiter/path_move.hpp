// A way of moving: through points, on one time law over all of them. While the whole of it is looked at, which takes
// seconds, the arm holds; what is wrong with it is said before anything moves.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/control/arbiter/background_job.hpp"
#include "host/control/arbiter/path_events.hpp"
#include "host/control/arbiter/path_timing.hpp"

namespace liana::arbiter {

constexpr double kPathStart_deg = 1.0;       // of every joint, how far the first point may be from the command
constexpr std::size_t kMaxPathPoints = 500;  // more than any plan has
constexpr double kMaxPathTime_s = 3500.0;    // steps of missions take an hour at most

template <class Arm>
struct PathRequest {
  std::vector<Joints<Arm>> points_rad;  // at least one
  double rate_rad_s = 0.0;              // no joint is faster
  double margin_m = kPathOff_m;         // clearance that the straight pieces between the points have to have
  std::string hash;                     // names it in events and states
};

// The request with every joint inside its range to the last bit. Throws RequestError (out_of_range, refused) naming
// point and joint by their numbers: one that is farther outside than rounding, or a first point away from the command.
template <class Arm>
PathRequest<Arm> admit_path(const typename Arm::Table& table, const Joints<Arm>& command_rad, PathRequest<Arm> request);

// Why the arm must not go straight from point to point; empty: it may. Called in another thread, with the place of the
// command as point 0. Without a margin it is a move to point 1: allowed is what verification allows.
template <class Arm>
using PathCheck =
    std::function<std::string(const std::vector<Joints<Arm>>& points_rad, std::optional<double> margin_m)>;

// What the whole of a path has come to.
template <class Arm>
struct PathPrecheck {
  std::string refusal;  // why it does not start; empty: it does
  std::optional<BlendedPath<Arm>> path;
  std::vector<double> along_rad;  // at the end of each command interval (path_timing.hpp)
};

template <class Arm>
PathPrecheck<Arm> look_at_path(const typename Arm::Table& table, const SpeedZone& zone, const PathCheck<Arm>& check,
                               const Joints<Arm>& from_rad, const PathRequest<Arm>& request);

template <class Arm>
class PathMove {
 public:
  static constexpr bool kIsPlanned = true;
  using Work = BackgroundJob<PathPrecheck<Arm>>;

  // `work` has begun to look at the path, and has to outlive this.
  PathMove(Work& work, SearchResult taken, const std::string& hash) : work_(work), taken_(taken), hash_(hash) {}
  ~PathMove() { work_.forget(); }
  PathMove(const PathMove&) = delete;
  PathMove& operator=(const PathMove&) = delete;

  PathProgress progress() const {
    if (next_ == 0) return {hash_, 0.0};
    return {hash_, static_cast<double>(next_) / static_cast<double>(outlook_->along_rad.size())};
  }
  // Of the whole path; 0 while it is looked at, and when it is refused.
  double duration_s(const typename Arm::Table& table) const {
    return outlook_ ? static_cast<double>(outlook_->along_rad.size()) * interval_s(table) : 0.0;
  }
  // What looking at it has come to; nothing yet.
  const std::optional<PathPrecheck<Arm>>& outlook() const { return outlook_; }

  Goal<Arm> next(const liana::Outputs<Arm>& now) {
    if (!outlook_) outlook_ = work_.take(taken_ == SearchResult::kInItsInterval);
    if (!outlook_) return {};
    const std::vector<double>& along_rad = outlook_->along_rad;
    is_over_ = !outlook_->refusal.empty() || (next_ >= along_rad.size() && now.at_rest != 0);
    if (!outlook_->refusal.empty()) return {};
    return outlook_->path->at(next_ < along_rad.size() ? along_rad[next_++] : along_rad.back());
  }
  // Refused, or the last point is reached and the arm, which follows, is at rest.
  bool is_over() const { return is_over_; }
  bool refused() { return false; }

 private:
  Work& work_;
  SearchResult taken_;
  std::string hash_;
  std::optional<PathPrecheck<Arm>> outlook_;
  std::size_t next_ = 0;  // of the intervals
  bool is_over_ = false;
};

}  // namespace liana::arbiter
