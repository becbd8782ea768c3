// The stored path.
#include "host/control/arbiter/path_history.hpp"

#include <gtest/gtest.h>

#include "firmware_like/cable_controller.hpp"

namespace liana::arbiter {

using namespace cable;
namespace {

using Path = PathHistory<ThetaVector>;

ThetaVector theta(double first_rad) {
  ThetaVector theta_rad{};
  theta_rad[0] = first_rad;
  return theta_rad;
}

// What a copy has that is told of every change.
class Copy {
 public:
  void follow(Path& path) {
    if (!path.has_change()) return;
    const PathChange<ThetaVector> change = path.take_change();
    first_ = change.first;
    points_.resize(change.kept);
    for (const auto& point : change.added) points_.push_back(point.joint_rad[0]);
  }
  std::vector<double> points() const { return {points_.begin() + static_cast<std::ptrdiff_t>(first_), points_.end()}; }

 private:
  std::uint64_t first_ = 0;
  std::vector<double> points_;  // by number
};

std::vector<double> points_of(const Path& path) {
  std::vector<double> points;
  for (std::size_t i = 0; i < path.size(); ++i) points.push_back(path.at(i).joint_rad[0]);
  return points;
}

TEST(PathHistory, CountsThePointsThatAreNotOlderThanATick) {
  Path path;
  for (std::uint64_t tick = 10; tick <= 50; tick += 10) path.note(tick, theta(static_cast<double>(tick)));
  EXPECT_EQ(path.count_since(0), 5u);
  EXPECT_EQ(path.count_since(30), 3u);
  EXPECT_EQ(path.count_since(31), 2u);
  EXPECT_EQ(path.count_since(51), 0u);
  path.drop_newest();
  EXPECT_EQ(path.newest().joint_rad[0], 40.0);
  EXPECT_EQ(path.count_since(30), 2u);
}

TEST(PathHistory, StandingStillAddsNothing) {
  Path path;
  for (std::uint64_t tick = 0; tick < 100; ++tick) path.note(tick, ThetaVector{});
  EXPECT_EQ(path.size(), 1u);
  path.begin(100, ThetaVector{});
  EXPECT_EQ(path.size(), 1u);
}

TEST(PathHistory, KnowsWhereTheArmWasEnabledBesideThePath) {
  Path path;
  path.begin(1, theta(0.0));
  path.note(2, theta(1.0));
  path.begin(3, theta(1.1));
  EXPECT_FALSE(path.at(0).begins) << "nothing lies before the first point";
  EXPECT_FALSE(path.at(1).begins);
  EXPECT_TRUE(path.at(2).begins);
}

TEST(PathHistory, OfPointsEquallyNearTheNewestIsTheNearest) {
  Path path;
  for (const double x : {0.0, 1.0, 2.0, 1.0}) path.note(1, theta(x));
  EXPECT_EQ(path.nearest(theta(0.9)), 3u);
  EXPECT_EQ(path.nearest(theta(1.8)), 2u);
}

TEST(PathHistory, OfAnArmThatStoppedOnItsWayBackEndsThereAndLeadsNeverInAgain) {
  Path path;
  for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0}) path.note(1, theta(x));
  path.come_back_to(theta(2.3));
  EXPECT_EQ(points_of(path), (std::vector<double>{0.0, 1.0, 2.3}));
  EXPECT_FALSE(path.newest().begins);
  path.begin(2, theta(9.0));
  path.come_back_to(theta(8.0));
  EXPECT_EQ(points_of(path), (std::vector<double>{0.0, 1.0, 2.3, 8.0}));
  EXPECT_TRUE(path.newest().begins) << "on the way onto the path";
}

TEST(PathHistory, ACopyThatIsToldOfEveryChangeHasWhatItHas) {
  Path path;
  Copy copy;
  copy.follow(path);
  for (const double x : {0.0, 1.0, 2.0, 3.0}) path.note(1, theta(x));
  copy.follow(path);
  EXPECT_EQ(copy.points(), points_of(path));
  EXPECT_FALSE(path.has_change());
  path.drop_newest();
  path.drop_newest();
  EXPECT_TRUE(path.has_change()) << "what is gone has to be told, too";
  copy.follow(path);
  EXPECT_EQ(copy.points(), points_of(path));
  path.drop_newest();
  path.note(2, theta(7.0));
  copy.follow(path);
  EXPECT_EQ(copy.points(), (std::vector<double>{0.0, 7.0}));
  path.clear();
  copy.follow(path);
  EXPECT_TRUE(copy.points().empty());
}

TEST(PathHistory, WhatIsRestoredIsNoChangeAndTheOldestGoFirstWhenItIsFull) {
  Path path;
  std::vector<Path::Point> kept(kMaxRetractPoints, Path::Point{});
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i].joint_rad[0] = static_cast<double>(i);
  path.restore(40, kept);
  EXPECT_FALSE(path.has_change());
  path.note(1, theta(-1.0));
  EXPECT_EQ(path.size(), kMaxRetractPoints);
  EXPECT_EQ(path.at(0).joint_rad[0], 1.0);
  const PathChange<ThetaVector> change = path.take_change();
  EXPECT_EQ(change.first, 41u);
  EXPECT_EQ(change.kept, 40u + kMaxRetractPoints);
  ASSERT_EQ(change.added.size(), 1u);
  EXPECT_EQ(change.added[0].joint_rad[0], -1.0);
}

}  // namespace
}  // namespace liana::arbiter
