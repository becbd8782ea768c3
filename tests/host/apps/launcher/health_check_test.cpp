#include "host/apps/launcher/health_check.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace liana::launcher {
namespace {

constexpr double kTick_s = 0.1;

// A server that listens, as one that hangs still does.
class HealthCheckOfAServer : public ::testing::Test {
 protected:
  HealthCheckOfAServer()
      : server_(api::bind_at(api::Transport::kTcp, {"127.0.0.1", 0})),
        check_({"127.0.0.1", api::port_of(server_.get())}, now_s_) {}
  double after(double seconds) {
    double silent_s = 0.0;
    for (double passed_s = 0.0; passed_s < seconds; passed_s += kTick_s) silent_s = check_.silent_s(now_s_ += kTick_s);
    return silent_s;
  }
  // The connection of the question under way; its answer would be heard by the next call.
  api::UniqueFd asked() {
    pollfd comes{server_.get(), POLLIN, 0};
    EXPECT_EQ(::poll(&comes, 1, 5000), 1) << "it asks";
    api::UniqueFd connection(::accept(server_.get(), nullptr, nullptr));
    after(5 * kTick_s);
    comes = {connection.get(), POLLIN, 0};
    EXPECT_EQ(::poll(&comes, 1, 5000), 1) << "it has sent its request";
    return connection;
  }

  double now_s_ = 100.0;
  api::UniqueFd server_;
  HealthCheck check_;
};

TEST_F(HealthCheckOfAServer, SilenceLastsUntilAnAnswerComesHoweverLate) {
  EXPECT_NEAR(after(20.0), 20.0, 0.2);
  const api::UniqueFd connection = asked();
  ASSERT_EQ(::send(connection.get(), "HTTP", 4, MSG_NOSIGNAL), 4);
  EXPECT_LT(after(0.5), 0.6);
  EXPECT_GT(after(8.0), 7.0) << "the next question is not answered";
}

TEST_F(HealthCheckOfAServer, TheEndOfTheConnectionIsAnAnswer) {
  EXPECT_GT(after(10.0), 9.0);
  { const api::UniqueFd connection = asked(); }
  EXPECT_LT(after(0.5), 0.6);
}

TEST_F(HealthCheckOfAServer, TimeInWhichNobodyLookedIsNoSilenceOfTheServer) {
  after(4.0);
  now_s_ += 1000.0;
  EXPECT_LT(after(1.0), 6.0);
}

TEST_F(HealthCheckOfAServer, WhereNobodyListensThereIsSilence) {
  server_ = api::UniqueFd();
  EXPECT_NEAR(after(20.0), 20.0, 0.2);
}

}  // namespace
}  // namespace liana::launcher
