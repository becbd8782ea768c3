// The operator's side of the API, message by message (req:A49).
#include "host/operator/operator_session.hpp"

#include <gtest/gtest.h>

#include "host/json/json.hpp"
#include "tests/host/operator/scene.hpp"

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

operator_side::OperatorSession session() {
  return operator_side::OperatorSession({LIANA_RECORDINGS_DIR}, panel_slit(), {}, 1);
}

TEST(OperatorSession, SendsNothingWhileNoDeviceIsItsToMove) {
  operator_side::OperatorSession operator_session = session();
  EXPECT_TRUE(operator_session.on_state({{"time_s", 0.0}, {"step", nullptr}}).empty());
  EXPECT_TRUE(operator_session.on_state(state(0.02, 1, "none", "none")).empty());
  EXPECT_TRUE(operator_session.on_state(state(0.04, 2, "vr", "none")).empty());
}

TEST(OperatorSession, PlaysTheRecordingInAVrStepThenSaysArrivedOnceWithTriggersReleased) {
  operator_side::OperatorSession operator_session = session();
  int says = 0;
  std::size_t samples = 0;
  double trigger = 0.0, highest_trigger = 0.0;
  for (int k = 1; k < 2200; ++k) {
    for (const Json& message : operator_session.on_state(state(0.02 * k, 2, "vr", "vr"))) {
      if (message["op"] == "operator_says") {
        ++says;
        EXPECT_EQ(message["what"], "arrived");
        EXPECT_EQ(trigger, 0.0);
        continue;
      }
      EXPECT_EQ(message["device"], "vr");
      samples += message["samples"].size();
      trigger = message["samples"].back()["right"]["trigger"];
      highest_trigger = std::max(highest_trigger, trigger);
    }
  }
  EXPECT_EQ(says, 1);
  EXPECT_EQ(highest_trigger, 1.0);
  EXPECT_GT(samples, 3400u);
}

// req:A24
TEST(OperatorSession, DeliversTwentyHandSamplesAnInterval) {
  operator_side::OperatorSession operator_session = session();
  operator_session.on_state(state(1.00, 4, "hand", "hand"));
  const auto messages = operator_session.on_state(state(1.02, 4, "hand", "hand"));
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(messages[0]["samples"].size(), 20u);
  EXPECT_EQ(messages[0]["samples"][0]["t_us"], 1001000);
  EXPECT_EQ(messages[0]["samples"][19]["t_us"], 1020000);
}

TEST(OperatorSession, GripsOnlyAfterPicturesHaveArrived) {
  operator_side::OperatorSession operator_session = session();
  bool gripped_blind = false, gripped = false;
  for (int k = 1; k < 400; ++k) {
    if (k > 200 && k % 2 == 0) {
      operator_session.on_camera(
          {{"op", "camera"}, {"capture_time_s", 0.0}, {"slit", {1.6, -0.3, -0.5, 1, 0, 0, 0}}, {"rod", nullptr}});
    }
    for (const Json& message : operator_session.on_state(state(0.02 * k, 4, "hand", "hand"))) {
      if (message["op"] != "device") continue;
      const bool button = message["samples"].back()["button"] == 1;
      (k <= 200 ? gripped_blind : gripped) |= button;
    }
  }
  EXPECT_FALSE(gripped_blind);
  EXPECT_TRUE(gripped);
}

TEST(OperatorSession, IgnoresThePoseInTheState) {  // it must see the arm through the camera only
  operator_side::OperatorSession with = session(), without = session();
  for (int k = 1; k < 200; ++k) {
    const Json camera{
        {"op", "camera"}, {"capture_time_s", 0.0}, {"slit", {1.6, -0.3, -0.5, 1, 0, 0, 0}}, {"rod", nullptr}};
    with.on_camera(camera);
    without.on_camera(camera);
    Json rich = state(0.02 * k, 4, "hand", "hand");
    rich["measured_cp"] = {k, k, k, 1, 0, 0, 0};
    rich["measured_js_deg"] = {k, k, k, k, k, k, k, k, k, k};
    EXPECT_EQ(with.on_state(rich), without.on_state(state(0.02 * k, 4, "hand", "hand")));
  }
}

TEST(OperatorSession, RefusesMalformedPictures) {
  operator_side::OperatorSession operator_session = session();
  EXPECT_THROW(operator_session.on_camera({{"slit", {1, 2, 3}}}), std::runtime_error);
  EXPECT_THROW(operator_session.on_camera({{"slit", {1, 2, 3, 1, 1, 0, 0}}}), std::runtime_error);
  EXPECT_NO_THROW(operator_session.on_camera({{"slit", nullptr}, {"rod", nullptr}}));
}

TEST(OperatorSession, AMissingRecordingIsNamed) {
  operator_side::OperatorSession operator_session({"/nonexistent"}, panel_slit(), {}, 1);
  try {
    operator_session.on_state(state(0.02, 2, "vr", "vr"));
    FAIL() << "no error";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nonexistent/panel_edge_vr.hand"), std::string::npos);
  }
}

}  // namespace
}  // namespace liana::test
