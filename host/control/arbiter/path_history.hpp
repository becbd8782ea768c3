// What the arm was commanded after verification, one point per command interval in which it moved: the way back out.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

namespace liana::arbiter {

constexpr std::size_t kMaxRetractPoints = 500000;  // 2.7 h of motion at 50 Hz; the oldest go first

template <class Joints>
struct PathPoint {
  std::uint64_t tick = 0;  // 0: of an earlier life of lianad
  Joints joint_rad{};
  bool begins = false;  // the arm was enabled here: from the point before it no command led here
};

// What has changed since the last look, for a copy elsewhere. Points have numbers that only grow: `first` is that of
// the oldest, those from `kept` on are gone, and `added` follow it.
template <class Joints>
struct PathChange {
  std::uint64_t first = 0;
  std::uint64_t kept = 0;
  std::vector<PathPoint<Joints>> added;
};

template <class Joints>
class PathHistory {
 public:
  using Point = PathPoint<Joints>;

  // Notes where the command stands at `tick`; points closer than 1e-7 rad to the last one are left out.
  void note(std::uint64_t tick, const Joints& joint_rad) { add({tick, joint_rad, false}); }
  // The same where the arm was enabled.
  void begin(std::uint64_t tick, const Joints& joint_rad) { add({tick, joint_rad, !points_.empty()}); }
  // What the copy still has of an earlier life, its oldest point with number `first`; nothing was noted before.
  void restore(std::uint64_t first, const std::vector<Point>& points) {
    points_.assign(points.begin(), points.end());
    first_ = first;
    told_ = copy_end_ = end();
  }
  void clear() { keep(0); }
  // Forgets all but the oldest `count`.
  void keep(std::size_t count) {
    if (count >= points_.size()) return;
    points_.resize(count);
    told_ = std::min(told_, end());
  }
  void drop_newest() { keep(points_.size() - 1); }
  // The arm, which was going back, has come to rest at `joint_rad`: forgets what lies beside or beyond that among the
  // newest points, and ends there.
  void come_back_to(const Joints& joint_rad) {
    if (points_.empty()) return;
    const std::size_t first = points_.size() > kStopPoints ? points_.size() - kStopPoints : 0;
    const std::size_t place = nearest(joint_rad, first);
    Point end{points_[place].tick, joint_rad, false};
    for (std::size_t i = place; i < points_.size(); ++i) end.begins = end.begins || points_[i].begins;
    keep(std::max<std::size_t>(place, 1));
    add(end);
  }

  bool empty() const { return points_.empty(); }
  std::size_t size() const { return points_.size(); }
  const Point& at(std::size_t i) const { return points_[i]; }
  const Point& newest() const { return points_.back(); }
  // How many are not older than `until_tick`. Cost: logarithmic.
  std::size_t count_since(std::uint64_t until_tick) const {
    const auto is_older = [](const Point& point, std::uint64_t tick) { return point.tick < tick; };
    const auto first = std::lower_bound(points_.begin(), points_.end(), until_tick, is_older);
    return static_cast<std::size_t>(points_.end() - first);
  }
  // Of the point whose joints differ least, by the joint that differs most; looks from `first` on, where there has to
  // be one. Cost: 5 ms at most.
  std::size_t nearest(const Joints& joint_rad, std::size_t first = 0) const {
    std::size_t best = first;
    double min_rad = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < points_.size(); ++i) {
      const double change_rad = largest_change(points_[i].joint_rad, joint_rad);
      if (change_rad > min_rad) continue;
      best = i;  // of equals the newest
      min_rad = change_rad;
    }
    return best;
  }

  // Whether the copy has to be told of something, and what; it knows all after that.
  bool has_change() const { return told_ != copy_end_ || told_ != end(); }
  PathChange<Joints> take_change() {
    PathChange<Joints> change{first_, std::max(first_, told_), {}};
    change.added.assign(points_.begin() + static_cast<std::ptrdiff_t>(change.kept - first_), points_.end());
    told_ = copy_end_ = end();
    return change;
  }

  static double largest_change(const Joints& a, const Joints& b) {
    double change = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) change = std::max(change, std::fabs(a[i] - b[i]));
    return change;
  }

 private:
  static constexpr double kSamePoint_rad = 1e-7;
  static constexpr std::size_t kStopPoints = 200;  // a stop takes fewer command intervals

  std::uint64_t end() const { return first_ + points_.size(); }
  void add(const Point& point) {
    if (!points_.empty() && largest_change(point.joint_rad, points_.back().joint_rad) < kSamePoint_rad) return;
    points_.push_back(point);
    if (points_.size() <= kMaxRetractPoints) return;
    points_.pop_front();
    ++first_;
  }

  std::deque<Point> points_;
  std::uint64_t first_ = 0;     // number of the oldest point
  std::uint64_t told_ = 0;      // up to this number the copy has what is here
  std::uint64_t copy_end_ = 0;  // number after the copy's last point
};

}  // namespace liana::arbiter
