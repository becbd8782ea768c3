#include "host/planning/planner/start/explore.hpp"

#include <algorithm>
#include <cmath>

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr double kReach_m = 0.6;  // motion of the arm in one growth step

// xorshift64*: numbers in [0, 1), the same everywhere.
class Sequence {
 public:
  explicit Sequence(std::uint64_t start) : state_(start * 0x9E3779B97F4A7C15ULL | 1u) {}
  double next() {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return static_cast<double>((state_ * 0x2545F4914F6CDD1DULL) >> 11) / 9007199254740992.0;
  }
  double between(double low, double high) { return low + (high - low) * next(); }

 private:
  std::uint64_t state_;
};

struct Node {
  ThetaVector theta;
  std::int32_t parent;
};
using Tree = std::vector<Node>;

std::int32_t nearest(const Room& room, const Tree& tree, const ThetaVector& theta) {
  Index best = 0;
  double least = 1e300;
  for (Index i = 0; i < tree.size(); ++i) {
    const double motion = room.motion_m(tree[i].theta, theta);
    if (motion < least) least = motion, best = i;
  }
  return static_cast<std::int32_t>(best);
}

// Grows from the nearest node towards theta by one reach; the new node's index, or -1 when an obstacle is in the way.
std::int32_t grow(const Room& room, Tree& tree, std::int32_t from, const ThetaVector& theta, double margin_m) {
  const ThetaVector start = tree[static_cast<Index>(from)].theta;
  const double motion = room.motion_m(start, theta);
  const ThetaVector end = motion > kReach_m ? between(start, theta, kReach_m / motion) : theta;
  if (!room.is_free(start, end, margin_m)) return -1;
  tree.push_back({end, from});
  return static_cast<std::int32_t>(tree.size()) - 1;
}

// Grows towards theta until it is reached (its index) or blocked (-1).
std::int32_t connect(const Room& room, Tree& tree, const ThetaVector& theta, double margin_m) {
  std::int32_t at = nearest(room, tree, theta);
  while (at >= 0 && room.motion_m(tree[static_cast<Index>(at)].theta, theta) > 1e-12)
    at = grow(room, tree, at, theta, margin_m);
  return at;
}

// A pose beside the straight line between the ends, ever farther from it in turn; held thetas as at the ends.
ThetaVector draw(const Room& room, const ExploreRequest& request, std::int32_t step, Sequence& random) {
  constexpr std::array<double, 4> kSpread{0.15, 0.3, 0.6, 1.0};  // of the limit
  const double spread = kSpread[static_cast<Index>(step % 4)];
  ThetaVector theta = between(request.from_rad, request.to_rad, random.next());
  for (Index k = 0; k < static_cast<Index>(room.table().theta_count()); ++k) {
    const double limit = room.table().segment[k / 2].theta_limit_rad;
    const double aside = random.between(-spread, spread) * limit;
    if (((request.held_mask >> k) & 1u) == 0) theta[k] = std::clamp(theta[k] + aside, -limit, limit);
  }
  return theta;
}

Path back_to_root(const Tree& tree, std::int32_t node) {
  Path path;
  for (; node >= 0; node = tree[static_cast<Index>(node)].parent) path.push_back(tree[static_cast<Index>(node)].theta);
  return path;
}

}  // namespace

Path explore(const Room& room, const ExploreRequest& request, const std::atomic<bool>* cancelled) {
  Tree from{{request.from_rad, -1}}, to{{request.to_rad, -1}};
  Sequence random(request.sequence);
  for (std::int32_t step = 0; step < kExploreSteps; ++step) {
    if (cancelled != nullptr && cancelled->load()) return {};
    const bool forward = step % 2 == 0;
    Tree &growing = forward ? from : to, &other = forward ? to : from;
    const ThetaVector theta = step == 0 ? request.to_rad : draw(room, request, step, random);
    const std::int32_t grown = grow(room, growing, nearest(room, growing, theta), theta, request.margin_m);
    if (grown < 0) continue;
    const std::int32_t met = connect(room, other, growing[static_cast<Index>(grown)].theta, request.margin_m);
    if (met < 0) continue;
    Path path = back_to_root(from, forward ? grown : met);
    std::reverse(path.begin(), path.end());
    const Path rest = back_to_root(to, forward ? met : grown);
    path.insert(path.end(), rest.begin() + 1, rest.end());
    return path;
  }
  return {};
}

Path shortcut(const Room& room, Path path, double margin_m, std::uint64_t sequence) {
  Sequence random(sequence);
  for (std::int32_t i = 0; i < kShortcutTries && path.size() > 2; ++i) {
    const double end = static_cast<double>(path.size() - 1);
    double a = random.between(0.0, end), b = random.between(0.0, end);
    if (a > b) std::swap(a, b);
    const Index first = static_cast<Index>(a), second = static_cast<Index>(b);
    if (first == second) continue;
    const ThetaVector start = between(path[first], path[first + 1], a - std::floor(a));
    const ThetaVector stop = between(path[second], path[second + 1], b - std::floor(b));
    if (!room.is_free(start, stop, margin_m)) continue;
    Path shorter(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(first) + 1);
    shorter.push_back(start);
    shorter.push_back(stop);
    shorter.insert(shorter.end(), path.begin() + static_cast<std::ptrdiff_t>(second) + 1, path.end());
    path = std::move(shorter);
  }
  return path;
}

}  // namespace liana::planner
