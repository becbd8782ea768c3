// The operator's side of the API, message by message (req:A49).
#include "host/operator/simulated/operator_session.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/base/json/json.hpp"
#include "tests/host/operator/simulated/scene.hpp"

namespace liana::test {
namespace {

Json state(double time_s, int step, const std::string& device, const std::string& in_use, bool engaged = true) {
  return {{"op", "state"},
          {"tick", 0},
          {"time_s", time_s},
          {"device", in_use},
          {"device_engaged", engaged},
          {"step", {{"index", step}, {"name", "somewhere"}, {"device", device}}},
          {"mapping", {{"scale", 4.0}, {"rotation_scale", 2.0}}}};
}

simulated::OperatorSession session(simulated::Temper temper = simulated::Temper::kGentle) {
  return simulated::OperatorSession({LIANA_RECORDINGS_DIR}, panel_slit(), {}, 1, temper);
}

TEST(OperatorSession, SendsNothingWhileNoDeviceIsItsToMove) {
  simulated::OperatorSession operator_session = session();
  for (const Json& seen :
       {Json{{"time_s", 0.0}, {"step", nullptr}}, state(0.02, 1, "none", "none"), state(0.04, 2, "vr", "none")}) {
    const simulated::OperatorAnswer answer = operator_session.on_state(seen);
    EXPECT_TRUE(answer.samples.empty() && answer.messages.empty()) << seen;
  }
}

TEST(OperatorSession, PlaysTheRecordingInAVrStepThenSaysArrivedOnceWithTriggersReleased) {
  simulated::OperatorSession operator_session = session();
  int says = 0;
  std::size_t samples = 0;
  double trigger = 0.0, highest_trigger = 0.0;
  for (int k = 1; k < 2200; ++k) {
    const simulated::OperatorAnswer answer = operator_session.on_state(state(0.02 * k, 2, "vr", "vr"));
    EXPECT_EQ(answer.kind, device::Kind::kVrControllers);
    for (const device::Sample& sample : answer.samples) {
      samples += sample.hand == 0 ? 1 : 0;
      trigger = sample.trigger;
      EXPECT_EQ(sample.deadman, trigger >= simulated::kGripped);
      highest_trigger = std::max(highest_trigger, trigger);
    }
    for (const Json& message : answer.messages) {
      ++says;
      EXPECT_EQ(message["op"], "operator_says");
      EXPECT_EQ(message["what"], "arrived");
      EXPECT_EQ(trigger, 0.0);
    }
  }
  EXPECT_EQ(says, 1);
  EXPECT_EQ(highest_trigger, 1.0);
  EXPECT_GT(samples, 3400u);
}

TEST(OperatorSession, LivelyHandsLoseGripsOnTheirRecordedWayHoldTheOtherDeviceTooAndArriveAllTheSame) {
  simulated::OperatorSession operator_session = session(simulated::Temper::kLively);
  int says = 0, grips = 0;
  bool held = false;
  std::int64_t before_us = 0, aside_before_us = 0;
  for (int k = 1; k < 3500; ++k) {
    const simulated::OperatorAnswer answer = operator_session.on_state(state(0.02 * k, 2, "vr", "vr"));
    for (const device::Sample& sample : answer.samples) {
      EXPECT_EQ(sample.deadman, sample.trigger >= simulated::kGripped);
      if (sample.hand != 0) continue;
      grips += sample.deadman && !held ? 1 : 0;
      held = sample.deadman;
      EXPECT_GE(sample.t_us, before_us);
      before_us = sample.t_us;
    }
    for (const device::Sample& sample : answer.aside) {
      EXPECT_GT(sample.t_us, aside_before_us);
      aside_before_us = sample.t_us;
    }
    says += static_cast<int>(answer.messages.size());
  }
  EXPECT_EQ(says, 1);
  EXPECT_GT(grips, 1);
  EXPECT_FALSE(held);
  EXPECT_GT(aside_before_us, 0);
}

TEST(OperatorSession, GentleHandsHoldOneDevice) {
  simulated::OperatorSession operator_session = session();
  for (int k = 1; k < 3500; ++k) ASSERT_TRUE(operator_session.on_state(state(0.02 * k, 2, "vr", "vr")).aside.empty());
}

// req:A24
TEST(OperatorSession, DeliversTwentyHandSamplesAnInterval) {
  simulated::OperatorSession operator_session = session();
  operator_session.on_state(state(1.00, 4, "hand", "hand"));
  const simulated::OperatorAnswer answer = operator_session.on_state(state(1.02, 4, "hand", "hand"));
  EXPECT_EQ(answer.kind, device::Kind::kHandController);
  ASSERT_EQ(answer.samples.size(), 20u);
  EXPECT_EQ(answer.samples.front().t_us, 1001000);
  EXPECT_EQ(answer.samples.back().t_us, 1020000);
}

TEST(OperatorSession, GripsOnlyAfterPicturesHaveArrived) {
  simulated::OperatorSession operator_session = session();
  bool gripped_blind = false, gripped = false;
  for (int k = 1; k < 400; ++k) {
    if (k > 200 && k % 2 == 0) {
      operator_session.on_camera(
          {{"op", "camera"}, {"capture_time_s", 0.0}, {"slit", {1.6, -0.3, -0.5, 1, 0, 0, 0}}, {"rod", nullptr}});
    }
    for (const device::Sample& sample : operator_session.on_state(state(0.02 * k, 4, "hand", "hand")).samples)
      (k <= 200 ? gripped_blind : gripped) |= sample.deadman;
  }
  EXPECT_FALSE(gripped_blind);
  EXPECT_TRUE(gripped);
}

TEST(OperatorSession, IgnoresThePoseInTheState) {  // it must see the arm through the camera only
  simulated::OperatorSession with = session(), without = session();
  for (int k = 1; k < 200; ++k) {
    const Json camera{
        {"op", "camera"}, {"capture_time_s", 0.0}, {"slit", {1.6, -0.3, -0.5, 1, 0, 0, 0}}, {"rod", nullptr}};
    with.on_camera(camera);
    without.on_camera(camera);
    Json rich = state(0.02 * k, 4, "hand", "hand");
    rich["measured_cp"] = {k, k, k, 1, 0, 0, 0};
    rich["measured_js_deg"] = {k, k, k, k, k, k, k, k, k, k};
    const auto seen = with.on_state(rich).samples,
               unseen = without.on_state(state(0.02 * k, 4, "hand", "hand")).samples;
    EXPECT_TRUE(std::equal(seen.begin(), seen.end(), unseen.begin(), unseen.end(), [](const auto& a, const auto& b) {
      return a.pose.position_m == b.pose.position_m && a.pose.quaternion == b.pose.quaternion && a.deadman == b.deadman;
    }));
  }
}

TEST(OperatorSession, RefusesMalformedPictures) {
  simulated::OperatorSession operator_session = session();
  EXPECT_THROW(operator_session.on_camera({{"slit", {1, 2, 3}}}), std::runtime_error);
  EXPECT_THROW(operator_session.on_camera({{"slit", {1, 2, 3, 1, 1, 0, 0}}}), std::runtime_error);
  EXPECT_NO_THROW(operator_session.on_camera({{"slit", nullptr}, {"rod", nullptr}}));
}

TEST(OperatorSession, AMissingRecordingIsNamed) {
  simulated::OperatorSession operator_session({"/nonexistent"}, panel_slit(), {}, 1);
  try {
    operator_session.on_state(state(0.02, 2, "vr", "vr"));
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/panel_edge_vr.hand"), std::string::npos);
  }
}

}  // namespace
}  // namespace liana::test
