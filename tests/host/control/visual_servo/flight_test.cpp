// The servo flown: the core's own tip filter, an arm 0.3 s behind it whose measured pose is beside the true one, and a
// camera that is late, noisy and drops images. The study's table, on seeds that nothing was tuned on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <random>
#include <vector>

#include "firmware_like/math/trig.hpp"
#include "firmware_like/operator_input/tip_filter.hpp"
#include "host/control/visual_servo/target_servo.hpp"
#include "tests/rounds.hpp"

namespace liana::visual_servo {
namespace {

constexpr double kTick_s = 0.004;
constexpr int kIntervalTicks = 5;
constexpr double kCommandInterval_s = kTick_s * kIntervalTicks;
constexpr double kArmLag_s = 0.3;

const Pose kFlownTo{{4.0, 0.5, 1.0}, quaternion_of({0.4, -0.3, 0.9})};
const Vec3 kStartOff_m{-0.53, 0.015, 0.020};  // of the goal, in the target's axes: the study's

struct Camera {
  double rate_hz, latency_s, noise_m, noise_rad, dropped;
};

// Limits of lua/robots/micro.lua.
const TipFilterConfig kFilter{{0.10, 0.10, 0.4}, {3 * kDegree, 3 * kDegree, 12 * kDegree}, kTick_s};

struct Flight {
  ServoPhase phase = ServoPhase::kStandby;
  double exit_s = 0.0;
  double error_m = 0.0;      // true, the largest of the axes
  double error_rad = 0.0;    // true
  double overshoot_m = 0.0;  // lateral, true
  double sway_m = 0.0;       // how far any axis comes away again from where it has been nearest
};

// The normal distribution of the standard library differs from library to library: only its engine is used.
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : engine_(seed) {}
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) / 9007199254740992.0; }
  double normal() { return std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * 3.141592653589793 * uniform()); }
  Vec3 vector(double deviation) { return {deviation * normal(), deviation * normal(), deviation * normal()}; }

 private:
  std::mt19937_64 engine_;
};

struct Image {
  double capture_s;
  Pose target_in_tip;
};

class Flown {
 public:
  Flown(const Camera& camera, std::uint64_t seed) : camera_(camera), noise_(seed) {
    off_ = {noise_.vector(0.005), quaternion_of(noise_.vector(0.5 * kDegree))};
    const Pose start_in_target{add({-0.108, 0.0, 0.0}, kStartOff_m), quaternion_of({0.0087, -0.0070, 0.0105})};
    const Pose true_tip = compose(kFlownTo, start_in_target);
    filter_.pose = arm_ = measured_of(true_tip);
    request_.target = "adapter";
    request_.place = {{-0.108, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  }

  Flight fly() {
    TargetServo servo(kCommandInterval_s);
    servo.begin(request_, filter_.pose);
    Vec3 nearest{1.0, 1.0, 1.0};
    Flight out;
    for (int interval = 0; servo.is_under_way() && interval < 10000; ++interval) {
      const double now_s = kCommandInterval_s * interval;
      servo.note_tip(now_s, arm_);
      photograph(now_s);
      deliver(now_s, servo);
      const auto goal = servo.next(filter_.pose);
      if (!goal) break;
      pass_interval(*goal);
      const Vec3 left = true_error().m;
      for (std::size_t i = 0; i < 3; ++i) {
        nearest[i] = std::min(nearest[i], std::fabs(left[i]));
        out.sway_m = std::max(out.sway_m, std::fabs(left[i]) - nearest[i]);
        if (i > 0) out.overshoot_m = std::max(out.overshoot_m, left[i] * kStartOff_m[i] / std::fabs(kStartOff_m[i]));
      }
    }
    const PoseError left = true_error();
    out.phase = servo.report().phase;
    out.exit_s = servo.report().duration_s;
    for (std::size_t i = 0; i < 3; ++i) out.error_m = std::max(out.error_m, std::fabs(left.m[i]));
    out.error_rad = norm(left.rad);
    return out;
  }

 private:
  // The arm's own reading of where the tip is: beside the truth by what its geometry is off.
  Pose measured_of(const Pose& true_tip) const { return compose(off_, true_tip); }
  Pose true_of(const Pose& measured) const { return compose(inverse(off_), measured); }
  PoseError true_error() const { return error_between(kFlownTo, compose(kFlownTo, request_.place), true_of(arm_)); }

  void photograph(double now_s) {
    if (now_s + 1e-9 < static_cast<double>(images_) / camera_.rate_hz) return;
    ++images_;
    const Pose sound = compose(inverse(true_of(arm_)), kFlownTo);
    const Pose noisy{add(sound.position_m, noise_.vector(camera_.noise_m)),
                     multiply(quaternion_of(noise_.vector(camera_.noise_rad)), sound.quaternion)};
    if (noise_.uniform() >= camera_.dropped) pending_.push_back({now_s, noisy});
  }

  void deliver(double now_s, TargetServo& servo) {
    while (!pending_.empty() && pending_.front().capture_s + camera_.latency_s <= now_s + 1e-9) {
      servo.see("adapter", pending_.front().capture_s, pending_.front().target_in_tip);
      pending_.pop_front();
    }
  }

  void pass_interval(const Pose& goal) {
    const Pose from = asked_.value_or(filter_.pose);
    const Vec3 turn = rotation_vector(multiply(goal.quaternion, conjugate(from.quaternion)));
    for (int tick = 1; tick <= kIntervalTicks; ++tick) {
      const double share = static_cast<double>(tick) / kIntervalTicks;
      filter_tip(kFilter,
                 {add(from.position_m, scale(subtract(goal.position_m, from.position_m), share)),
                  normalize(multiply(quaternion_of(scale(turn, share)), from.quaternion))},
                 filter_);
      const double lag = kTick_s / kArmLag_s;
      const Vec3 behind = rotation_vector(multiply(filter_.pose.quaternion, conjugate(arm_.quaternion)));
      arm_ = {add(arm_.position_m, scale(subtract(filter_.pose.position_m, arm_.position_m), lag)),
              normalize(multiply(quaternion_of(scale(behind, lag)), arm_.quaternion))};
    }
    asked_ = goal;
  }

  Camera camera_;
  Noise noise_;
  Pose off_{};
  ServoRequest request_;
  TipFilterState filter_{};
  Pose arm_{};
  std::optional<Pose> asked_;
  std::deque<Image> pending_;
  std::int64_t images_ = 0;
};

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

struct Table {
  int done = 0;
  double exit_median_s, exit_95_s, error_95_m, error_most_m, turn_most_rad, overshoot_most_m, sway_most_m;
};

Table fly_all(const char* name, const Camera& camera, std::uint64_t first_seed, int count) {
  std::vector<double> exit_s, error_m, turn_rad, overshoot_m, sway_m;
  Table out{};
  for (int i = 0; i < count; ++i) {
    const Flight flight = Flown(camera, first_seed + static_cast<std::uint64_t>(i)).fly();
    if (flight.phase != ServoPhase::kDone) continue;
    ++out.done;
    exit_s.push_back(flight.exit_s);
    error_m.push_back(flight.error_m);
    turn_rad.push_back(flight.error_rad);
    overshoot_m.push_back(flight.overshoot_m);
    sway_m.push_back(flight.sway_m);
  }
  if (exit_s.empty()) return out;
  out.exit_median_s = quantile(exit_s, 0.5);
  out.exit_95_s = quantile(exit_s, 0.95);
  out.error_95_m = quantile(error_m, 0.95);
  out.error_most_m = quantile(error_m, 1.0);
  out.turn_most_rad = quantile(turn_rad, 1.0);
  out.overshoot_most_m = quantile(overshoot_m, 1.0);
  out.sway_most_m = quantile(sway_m, 1.0);
  std::printf("| %s | %d of %d | %.1f / %.1f | %.2f / %.2f | %.2f | %.1f | %.1f |\n", name, out.done, count,
              out.exit_median_s, out.exit_95_s, 1e3 * out.error_95_m, 1e3 * out.error_most_m,
              out.turn_most_rad / kDegree, 1e3 * out.overshoot_most_m, 1e3 * out.sway_most_m);
  return out;
}

constexpr std::uint64_t kUnseenSeed = 70001;
constexpr int kFlights = rounds(200), kFewer = rounds(100);

// req:B16 req:B24 req:B28
TEST(Flight, TheStudysCameraLeadsToItsPlaceWithinAMillimetreInTheSourcesTime) {
  const Table table = fly_all("10 Hz, 2 mm", {10.0, 0.2, 0.002, 0.2 * kDegree, 0.0}, kUnseenSeed, kFlights);
  EXPECT_EQ(table.done, kFlights);
  EXPECT_GT(table.exit_median_s, 25.0);
  EXPECT_LT(table.exit_95_s, 40.0);
  EXPECT_LT(table.error_95_m, 0.001);
  EXPECT_LT(table.turn_most_rad, 0.5 * kDegree);
  EXPECT_LT(table.overshoot_most_m, 0.0015);
  EXPECT_LT(table.sway_most_m, 0.015);
}

TEST(Flight, ASlowerCameraAndOneThatDropsAThirdOfItsImagesDoToo) {
  const Table slow = fly_all("5 Hz, 2 mm", {5.0, 0.2, 0.002, 0.2 * kDegree, 0.0}, kUnseenSeed, kFewer);
  const Table dropping =
      fly_all("10 Hz, 2 mm, a third dropped", {10.0, 0.2, 0.002, 0.2 * kDegree, 0.33}, kUnseenSeed, kFewer);
  for (const Table& table : {slow, dropping}) {
    EXPECT_GE(table.done, kFewer - 1);
    EXPECT_LT(table.exit_95_s, 40.0);
    EXPECT_LT(table.error_95_m, 0.0012);
  }
}

TEST(Flight, ABetterCameraErrsLess) {
  const Table table =
      fly_all("10 Hz, 2 mm = 3 sigma", {10.0, 0.2, 0.002 / 3, 0.2 / 3 * kDegree, 0.0}, kUnseenSeed, kFewer);
  EXPECT_EQ(table.done, kFewer);
  EXPECT_LT(table.error_most_m, 0.0008);
}

}  // namespace
}  // namespace liana::visual_servo
