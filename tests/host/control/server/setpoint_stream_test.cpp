// Setpoints that are repeated, overtaken, too old or too far away, and owners that stand still.
#include "host/control/server/setpoint_stream.hpp"

#include <gtest/gtest.h>

#include "host/api/server/request_check.hpp"
#include "host/api/server/request_error.hpp"
#include "tests/host/api/server/robots.hpp"
#include "tests/message.hpp"

namespace liana::server {
namespace {

class Stream : public testing::Test {
 protected:
  // "" or the refusal of {op, goal at x m, fields} at `now_s`; accepted ones are noted.
  std::string send(const char* op, double x_m, double now_s, Json fields = Json::object()) {
    fields["op"] = op;
    fields["goal"] = Json{x_m, 0, 0, 1, 0, 0, 0};
    const api::Arguments setpoint = api::checked(api::row_of(fields), fields, bounds_);
    try {
      stream_.check(api::row_of(fields), setpoint, now_s, tip_);
      stream_.note(api::row_of(fields), setpoint, now_s);
    } catch (const api::RequestError& error) {
      return error.code() + ": " + error.what();
    }
    return "";
  }
  std::string servo(double x_m, double now_s, Json fields = Json::object()) {
    return send("servo_cp", x_m, now_s, std::move(fields));
  }

  api::RequestBounds bounds_ = api::request_bounds(api::zhu2022_json());
  SetpointStream stream_{bounds_};
  Pose tip_{{1, 0, 0}, {1, 0, 0, 0}};
};

TEST_F(Stream, SequencesGrowOverAllSetpointsOfAnOwner) {
  EXPECT_EQ(servo(1, 0, {{"sequence", 5}}), "");
  EXPECT_TRUE(names(servo(1, 0, {{"sequence", 5}}), {"refused", "sequence", "5", "6"}));
  EXPECT_EQ(servo(1, 0, {{"sequence", 4}}).substr(0, 8), "refused:");
  EXPECT_EQ(servo(1, 0), "") << "a setpoint may have none";
  EXPECT_EQ(send("move_cp", 1, 0, {{"sequence", 9}}), "");
  EXPECT_EQ(servo(1, 0, {{"sequence", 8}}).substr(0, 8), "refused:");
  stream_.restart();
  EXPECT_EQ(servo(1, 0, {{"sequence", 1}}), "") << "another owner counts anew";
}

TEST_F(Stream, ARefusedSetpointUsesNoNumberUp) {
  EXPECT_NE(servo(2, 0, {{"sequence", 1}}), "") << "it jumps";
  EXPECT_EQ(servo(1, 0, {{"sequence", 1}}), "");
}

// req:A12 req:A13
TEST_F(Stream, ASetpointThatWaitedOnItsWayLongerThanItLivesIsRefused) {
  const auto at = [&](double clock_s, double now_s) { return servo(1, now_s, {{"time_s", clock_s}, {"ttl_s", 0.2}}); };
  EXPECT_EQ(at(1000.0, 5.0), "") << "whatever the two clocks show";
  EXPECT_EQ(at(1000.1, 5.3), "") << "0.2 s later than it could be";
  EXPECT_TRUE(names(at(1000.2, 5.5), {"refused", "ttl_s"}));
  EXPECT_EQ(at(1000.6, 5.6), "");
  EXPECT_TRUE(names(at(1000.5, 5.6), {"refused", "time_s", "1000.5"})) << "the clock goes back";
}

TEST_F(Stream, ClocksThatRunApartSlowlyMakeNoSetpointOld) {
  for (int second = 0; second < 36000; second += 5)
    ASSERT_EQ(servo(1, second, {{"time_s", 100.0 + 0.9999 * second}, {"ttl_s", 0.05}}), "") << second;
}

TEST_F(Stream, AGoalMayBeAsFarFromTheOneBeforeAsTheTipComesInHalfASecond) {
  const std::string said = servo(1.06, 0);
  EXPECT_TRUE(names(said, {"out_of_range", "goal", "0", "0.05 m", "move_cp"}));
  for (int i = 1; i <= 10; ++i) EXPECT_EQ(servo(1 + 0.049 * i, 0), "") << "far away in small steps";
  EXPECT_TRUE(names(servo(1.6, 0), {"out_of_range", "goal", "before"}));
  EXPECT_EQ(servo(1.04, 0), "") << "back to where the tip is may always be asked for";
  stream_.end();
  EXPECT_NE(servo(1.08, 0), "") << "the next stream begins at the tip";
  EXPECT_EQ(send("move_cp", 1.5, 0), "") << "a move plans its own way";
}

TEST_F(Stream, ATurnIsBoundedToo) {
  tip_.quaternion = {0.9961946980917455, 0.08715574274765817, 0, 0};  // 10 deg about x
  EXPECT_EQ(servo(1, 0), "");
  stream_.end();
  tip_.quaternion = {0.9945218953682733, 0.10452846326765347, 0, 0};  // 12 deg
  EXPECT_TRUE(names(servo(1, 0), {"out_of_range", "goal", "0", "10 deg"}));
}

TEST_F(Stream, AnOwnerStandsStillWhenItsTimeToLiveIsOverAndItsGoalIsNotReached) {
  EXPECT_FALSE(stream_.overdue(1e9, tip_)) << "nobody streams";
  servo(1.02, 10.0, {{"ttl_s", 0.2}});
  EXPECT_FALSE(stream_.overdue(10.2, tip_));
  EXPECT_EQ(stream_.overdue(10.22, tip_), 0.2);
  EXPECT_FALSE(stream_.overdue(10.24, tip_)) << "told once";
  servo(1.02, 10.0, {{"ttl_s", 0.2}});
  servo(1.02, 10.1, {{"ttl_s", 0.2}});
  EXPECT_FALSE(stream_.overdue(10.3, tip_)) << "the next one came";
}

TEST_F(Stream, NobodyIsMissedAtTheGoalAfterAMoveOrWithoutATimeToLive) {
  servo(1.0, 10.0, {{"ttl_s", 0.2}});
  EXPECT_FALSE(stream_.overdue(11.0, tip_)) << "the tip is there";
  servo(1.02, 10.0, {{"ttl_s", 0.2}});
  send("move_cp", 1.3, 10.1);
  EXPECT_FALSE(stream_.overdue(11.0, tip_)) << "a move needs nobody";
  servo(1.02, 10.0);
  EXPECT_FALSE(stream_.overdue(11.0, tip_));
}

TEST_F(Stream, TheQuickestSetpointSaysHowLateTheOthersAre) {
  const auto at = [&](double clock_s, double now_s) { return servo(1, now_s, {{"time_s", clock_s}, {"ttl_s", 0.2}}); };
  EXPECT_EQ(at(5.0, 2000.3), "") << "a clock that is behind";
  EXPECT_EQ(at(5.0, 2000.32), "") << "the same time twice";
  EXPECT_EQ(at(5.5, 2000.5), "") << "quicker by 0.3 s";
  EXPECT_EQ(at(5.6, 2000.79), "");
  EXPECT_EQ(at(5.7, 2000.91).substr(0, 8), "refused:");
  for (int second = 1; second < 1000; ++second) ASSERT_EQ(at(6.0 + second, 2001.0 + second), "") << second;
  EXPECT_EQ(at(1006.0, 2001.0 + 1000.21).substr(0, 8), "refused:") << "clocks drift from the last one on, not for ever";
  stream_.restart();
  EXPECT_EQ(at(1.0, 3001.0), "") << "another owner's clock";
}

TEST_F(Stream, AGoalIsReachedWithinTenMicrometresAndTheNewestTimeToLiveCounts) {
  servo(1.0 + 0.95e-5, 10.0, {{"ttl_s", 0.2}});
  EXPECT_FALSE(stream_.overdue(11.0, tip_));
  servo(1.0 + 1.05e-5, 10.0, {{"ttl_s", 0.2}});
  EXPECT_EQ(stream_.overdue(11.0, tip_), 0.2);
  servo(1.02, 10.0, {{"ttl_s", 0.2}});
  servo(1.02, 10.1);
  EXPECT_FALSE(stream_.overdue(11.0, tip_)) << "the last one has none";
}

}  // namespace
}  // namespace liana::server
