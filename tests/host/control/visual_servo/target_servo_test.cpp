#include "host/control/visual_servo/target_servo.hpp"

#include <gtest/gtest.h>

#include <functional>
#include "tests/message.hpp"

namespace liana::visual_servo {
namespace {

constexpr double kInterval_s = 0.02;
const Pose kTarget{{2.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};

ServoRequest near_request() {
  ServoRequest request;
  request.target = "adapter";
  request.place = {{-0.1, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  request.timeout_s = 60.0;
  return request;
}

// A tip that does what it is asked to; a camera without errors, five intervals between images, `camera` may spoil them.
struct Bench {
  using Camera = std::function<void(double now_s, TargetServo&, const Pose& tip)>;

  TargetServo servo{kInterval_s};
  Pose tip{{1.88, 0.0, 0.005}, {1.0, 0.0, 0.0, 0.0}};
  double now_s = 0.0;
  int goals = 0;

  static void sound(double now_s, TargetServo& servo, const Pose& tip) {
    servo.see("adapter", now_s, compose(inverse(tip), kTarget));
  }
  void run(const Camera& camera, double until_s) {
    for (int i = 0; now_s < until_s; ++i) {
      now_s += kInterval_s;
      servo.note_tip(now_s, tip);
      if (i % 5 == 0) camera(now_s, servo, tip);
      if (const auto goal = servo.next(tip)) {
        tip = *goal;
        ++goals;
      }
    }
  }
};

TEST(TargetServo, StandsByUntilItIsAskedFor) {
  Bench bench;
  bench.run(Bench::sound, 2.0);
  EXPECT_EQ(bench.servo.report().phase, ServoPhase::kStandby);
  EXPECT_EQ(bench.goals, 0);
}

// req:B16
TEST(TargetServo, ArrivesDwellsAndEndsByItself) {
  Bench bench;
  bench.servo.begin(near_request(), bench.tip);
  bool dwelt = false;
  bench.run(
      [&](double now_s, TargetServo& servo, const Pose& tip) {
        dwelt = dwelt || servo.report().phase == ServoPhase::kDwelling;
        Bench::sound(now_s, servo, tip);
      },
      40.0);
  EXPECT_TRUE(dwelt);
  EXPECT_EQ(bench.servo.report().phase, ServoPhase::kDone);
  EXPECT_EQ(bench.servo.report().reason, "");
  EXPECT_LT(norm(bench.servo.report().error->m), 0.0006 * 1.8);
  EXPECT_LT(bench.servo.report().duration_s, 30.0);
  EXPECT_FALSE(bench.servo.next(bench.tip));
}

TEST(TargetServo, ADwellThatIsInterruptedBeginsAnew) {
  Bench bench;
  ServoRequest request = near_request();
  request.dwell_s = 5.0;
  request.tau_s = 0.2;
  bench.servo.begin(request, bench.tip);
  double first_s = 0.0;
  bench.run(
      [&](double now_s, TargetServo& servo, const Pose& tip) {
        if (first_s == 0.0 && servo.report().phase == ServoPhase::kDwelling) first_s = now_s;
        Pose target = kTarget;
        if (first_s > 0.0 && now_s > first_s + 2.0 && now_s < first_s + 3.0) target.position_m[1] += 0.002;
        servo.see("adapter", now_s, compose(inverse(tip), target));
      },
      60.0);
  EXPECT_EQ(bench.servo.report().phase, ServoPhase::kDone);
  EXPECT_GT(bench.servo.report().duration_s, first_s + 7.5);
}

TEST(TargetServo, ATargetThatIsNeverSeenIsLostAndNothingMoves) {
  Bench bench;
  const Pose before = bench.tip;
  bench.servo.begin(near_request(), bench.tip);
  bench.run([](double, TargetServo&, const Pose&) {}, 3.0);
  EXPECT_EQ(bench.servo.report().phase, ServoPhase::kLost);
  EXPECT_TRUE(names(bench.servo.report().reason, {"not seen"}));
  EXPECT_EQ(bench.tip.position_m, before.position_m);
}

struct Loss {
  const char* reason;
  Bench::Camera camera;
};

TEST(TargetServo, ATargetThatIsLostOnTheWayIsSaidToBeForItsReason) {
  const Pose stuck = compose(inverse(Pose{{1.89, 0.0, 0.0}, {1, 0, 0, 0}}), kTarget);
  const Loss losses[] = {
      {"it is not seen", [](double, TargetServo&, const Pose&) {}},
      {"not seen", [](double now_s, TargetServo& servo,
                      const Pose& tip) { servo.see("transfer mechanism", now_s, compose(inverse(tip), kTarget)); }},
      {"30 mm or 3 deg",
       [](double now_s, TargetServo& servo, const Pose& tip) {
         servo.see("adapter", now_s, compose(inverse(tip), Pose{{2.0, 0.05, 0.0}, {1, 0, 0, 0}}));
       }},
      {"do not change", [stuck](double now_s, TargetServo& servo, const Pose&) { servo.see("adapter", now_s, stuck); }},
      {"not remembered", [](double now_s, TargetServo& servo,
                            const Pose& tip) { servo.see("adapter", now_s + 1.0, compose(inverse(tip), kTarget)); }},
      {"older than one before",
       [](double, TargetServo& servo, const Pose& tip) { servo.see("adapter", 0.5, compose(inverse(tip), kTarget)); }},
  };
  for (const Loss& loss : losses) {
    Bench bench;
    bench.servo.begin(near_request(), bench.tip);
    bench.run(Bench::sound, 3.0);
    ASSERT_EQ(bench.servo.report().phase, ServoPhase::kApproaching) << loss.reason;
    bench.run(loss.camera, 8.0);
    EXPECT_EQ(bench.servo.report().phase, ServoPhase::kLost) << loss.reason;
    EXPECT_NE(bench.servo.report().reason.find(loss.reason), std::string::npos) << bench.servo.report().reason;
  }
}

TEST(TargetServo, ImagesThatFailForLessThanItsPatienceAreBridged) {
  Bench bench;
  bench.servo.begin(near_request(), bench.tip);
  bench.run(
      [](double now_s, TargetServo& servo, const Pose& tip) {
        if (now_s < 3.0 || now_s > 3.8) Bench::sound(now_s, servo, tip);
      },
      40.0);
  EXPECT_EQ(bench.servo.report().phase, ServoPhase::kDone);
}

TEST(TargetServo, ATargetThatCannotBeReachedInTimeEndsIt) {
  Bench bench;
  ServoRequest request = near_request();
  request.timeout_s = 4.0;
  bench.servo.begin(request, bench.tip);
  bench.run(Bench::sound, 10.0);
  EXPECT_EQ(bench.servo.report().phase, ServoPhase::kTimedOut);
  EXPECT_NEAR(bench.servo.report().duration_s, 4.0, 0.05);
}

// What it holds is 0.5 m long and askew in it by 0.02 rad: the point arrives, turned as it should be, not the tip.
TEST(TargetServo, APointOfWhatTheArmHoldsIsLedToItsPlace) {
  ServoRequest request = near_request();
  request.point_in_tip = {{0.5, 0.0, 0.01}, quaternion_of({0.0, 0.0, 0.02})};
  Bench bench;
  bench.tip = {{1.35, 0.0, 0.005}, {1.0, 0.0, 0.0, 0.0}};
  bench.servo.begin(request, bench.tip);
  bench.run(Bench::sound, 60.0);
  EXPECT_EQ(bench.servo.report().phase, ServoPhase::kDone);
  const Pose point = compose(bench.tip, request.point_in_tip);
  EXPECT_LT(norm(subtract(point.position_m, {1.9, 0.0, 0.0})), 0.001);
  EXPECT_LT(norm(rotation_vector(point.quaternion)), 0.0071);
}

// req:B16
TEST(TargetServo, OnABaseThatSwingsTheTipTakesTwiceTheSlowPeriodAndTheQuickOneForItsWay) {
  ServoRequest request = near_request();
  request.swings = {20.0, 5.0};
  request.calming = 0.0;
  request.timeout_s = 120.0;
  Bench bench;
  bench.tip.position_m[0] = 1.4;  // half a metre to go
  bench.servo.begin(request, bench.tip);
  bench.run(Bench::sound, 100.0);
  EXPECT_EQ(bench.servo.report().phase, ServoPhase::kDone);
  EXPECT_GT(bench.servo.report().duration_s, 45.0);
  EXPECT_LT(bench.servo.report().duration_s, 75.0);
  EXPECT_NEAR(bench.tip.position_m[0], 1.9, 0.0006);
}

TEST(TargetServo, WhoEndsItSaysWhy) {
  Bench bench;
  bench.servo.begin(near_request(), bench.tip);
  bench.run(Bench::sound, 3.0);
  bench.servo.end("held");
  EXPECT_EQ(bench.servo.report().phase, ServoPhase::kStandby);
  EXPECT_EQ(bench.servo.report().reason, "held");
  EXPECT_FALSE(bench.servo.next(bench.tip));
}

}  // namespace
}  // namespace liana::visual_servo
