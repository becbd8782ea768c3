// The processes of a run, with shell scripts in place of the programs and a thread in place of lianad's API.
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "host/apps/launcher/console_session.hpp"
#include "host/apps/launcher/run_session.hpp"
#include "host/apps/launcher/silence.hpp"
#include "host/base/json/json.hpp"
#include "host/base/net/socket.hpp"
#include "tests/message.hpp"

namespace liana::launcher {
namespace {

// Answers as lianad does: welcome, states, and after a stop DISABLED.
class FakeDaemon {
 public:
  // `deaf`: leaves when it hears a stop, without having stopped anything.
  explicit FakeDaemon(const std::string& path, bool deaf = false)
      : deaf_(deaf),
        farewell_(path + ".farewell"),
        listener_(api::listen_at("--api", path)),
        thread_([this] { serve(); }) {}
  ~FakeDaemon() {
    quit_ = true;
    thread_.join();
  }
  // Whether it has heard that, or hears it soon: what was sent last may still lie in its socket.
  bool saw(const std::string& op) const {
    const std::atomic<bool>& heard = op == "stop" ? stopped_ : op == "mission_control" ? told_ : shut_down_;
    for (int i = 0; i < 300 && !heard; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return heard;
  }

 private:
  void serve() {
    while (!quit_ && !api::wait_readable(listener_.get(), 0.01)) {
    }
    if (quit_) return;
    const api::UniqueFd client(accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    for (int tick = 0; !quit_ && !shut_down_; ++tick) {
      if (stopped_ && deaf_) return;
      Json state{{"op", "state"},
                 {"tick", tick},
                 {"time_s", 0.5},
                 {"state", stopped_ ? "DISABLED" : "ENABLED"},
                 {"clearance", {{"distance_m", 0.1}}},
                 {"stop", nullptr}};
      if (stopped_) state["stop"] = {{"by", "liana run"}, {"reason", "interrupted"}, {"tick", tick}};
      api::send_packet(client.get(), state.dump());
      std::string packet;
      if (!api::wait_readable(client.get(), 0.01) ||
          api::receive_packet(client.get(), packet) != api::SocketResult::kDone)
        continue;
      const std::string op = Json::parse(packet)["op"];
      if (op == "hello") api::send_packet(client.get(), R"({"op":"welcome","config_hash":"abc","period_s":0.004})");
      if (op == "stop") stopped_ = true;
      if (op == "mission_control") told_ = true;
      if (op == "shutdown") shut_down_ = true;
    }
    say_farewell(client);
  }

  // The last states, faster than they are read; lianad's stand-in ends at once after them.
  void say_farewell(const api::UniqueFd& client) {
    for (int i = 0; i < 60; ++i) {
      const Json state{{"op", "state"},
                       {"tick", 1000 + i},
                       {"time_s", 9.5},
                       {"state", i < 59 ? "STOPPING" : "DISABLED"},
                       {"stop", nullptr}};
      api::send_packet(client.get(), state.dump());
    }
    std::ofstream(farewell_) << "said";
  }

  bool deaf_;
  std::string farewell_;
  api::UniqueFd listener_;
  std::atomic<bool> quit_ = false, stopped_ = false, shut_down_ = false, told_ = false;
  std::thread thread_;
};

class Session : public testing::Test {
 protected:
  Session() {
    plan_.directory = testing::TempDir() + "liana-session-" + std::to_string(getpid());
    std::filesystem::create_directories(plan_.directory);
    plan_.socket_dir = plan_.directory;
    plan_.time_mode = "real";  // this daemon waits for nobody
  }
  ~Session() override { std::filesystem::remove_all(plan_.directory); }

  void add(const std::string& name, const std::string& script) {
    plan_.programs.push_back({name, {"/bin/sh", "-c", script}});
  }
  // A program that lives until it is told to end, as bus, bench and operator do.
  void add_living(const std::string& name) { add(name, "exec sleep 60"); }

  SystemLayout plan_;
};

TEST_F(Session, AMissionThatEndsByItselfLeavesTheOutcomeToItsReport) {
  const FakeDaemon daemon(plan_.api_socket());
  add("lianad", "exec sleep 0.5");
  add("liana-mission", "echo '{}' > " + plan_.file("mission.json"));
  RunSession session(plan_);
  const RunResult end = session.run();
  EXPECT_EQ(end.outcome, "");
  EXPECT_TRUE(daemon.saw("shutdown"));
  EXPECT_EQ(session.welcome()["config_hash"], "abc");
  EXPECT_FALSE(session.states().empty());
}

TEST_F(Session, OnlyASimulatedArmsStatesAreKeptForTheReport) {
  const auto run = [&] {
    const FakeDaemon daemon(plan_.api_socket());
    auto session = std::make_unique<RunSession>(plan_);
    session->run();
    return session;
  };
  add("lianad", "exec sleep 0.5");
  add("liana-mission", "sleep 0.3; echo '{}' > " + plan_.file("mission.json"));
  const auto real = run();
  EXPECT_EQ(real->states().size(), 1u);
  EXPECT_EQ(real->states().back().tick, real->last_state()["tick"].get<std::uint64_t>());
  EXPECT_TRUE(real->claims().empty());
  std::filesystem::remove(plan_.api_socket());
  add_living("liana-bench");
  const auto simulated = run();
  EXPECT_GT(simulated->states().size(), 2u);
  EXPECT_GT(simulated->claims().size(), 1u);
}

TEST_F(Session, EveryChangeOfStateIsShownOnceAndInOrderUpToTheEnd) {
  const FakeDaemon daemon(plan_.api_socket());
  add("lianad", "while [ ! -e " + plan_.api_socket() + ".farewell ]; do :; done");
  add("liana-mission", "echo '{\"outcome\":\"success\"}' > " + plan_.file("mission.json"));
  RunSession session(plan_);
  testing::internal::CaptureStderr();
  session.run();
  const std::string shown = testing::internal::GetCapturedStderr();
  EXPECT_NE(shown.find("ENABLED\n    9.5 s  STOPPING\n    9.5 s  DISABLED\n"), std::string::npos) << shown;
}

TEST_F(Session, ADyingBenchEndsTheRunWithItsNameAndLastLines) {
  const FakeDaemon daemon(plan_.api_socket());
  add("lianad", "exec sleep 0.5");
  add("liana-bench", "sleep 0.2; echo first; echo cable 7 tore >&2; exit 3");
  add_living("liana-mission");
  const RunResult end = RunSession(plan_).run();
  EXPECT_EQ(end.outcome, "failed");
  EXPECT_TRUE(names(end.message, {"liana-bench", "code 3"}));
  EXPECT_NE(end.message.find("cable 7 tore"), std::string::npos) << end.message;
}

TEST_F(Session, OfABenchAndALianadThatFailAlikeTheBenchIsTheReasonWithItsOwnWords) {
  const FakeDaemon daemon(plan_.api_socket());
  add("lianad", "sleep 0.3; echo 'lianad: no bus' >&2; exit 1");
  add("liana-bench", "sleep 0.2; echo 'liana-bench: cable 7 tore' >&2; echo goodbye; exit 1");
  add_living("liana-mission");
  const RunResult end = RunSession(plan_).run();
  EXPECT_TRUE(names(end.message.substr(0, end.message.find('\n')), {"liana-bench", "code 1", "cable 7 tore"}));
}

TEST_F(Session, AProgramThatIsKilledEndsTheMissionToo) {
  const FakeDaemon daemon(plan_.api_socket());
  add("lianad", "exec sleep 0.5");
  add("liana-operator", "sleep 0.1; kill -9 $$");
  add_living("liana-mission");
  const RunResult end = RunSession(plan_).run();
  EXPECT_EQ(end.outcome, "failed");
  EXPECT_TRUE(names(end.message, {"liana-operator", "signal 9"}));
  EXPECT_TRUE(daemon.saw("mission_control"));
}

TEST_F(Session, AScriptsProcessThatStandsStillIsNamedAsItsRunner) {
  const api::UniqueFd mute = api::listen_at("--api", plan_.api_socket());
  add_living("lianad");
  add("liana-mission", "sleep 60 & kill -STOP $!; sleep 5; kill -9 $!; kill -INT $PPID; exec sleep 60");
  RunSession session(plan_);
  testing::internal::CaptureStderr();
  session.run();
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(names(said, {"3 s", "liana-mission"}));
}

TEST_F(Session, AKilledMissionRunnerFailsTheRun) {
  const FakeDaemon daemon(plan_.api_socket());
  add("lianad", "exec sleep 0.5");
  add("liana-mission", "kill -9 $$");
  const RunResult end = RunSession(plan_).run();
  EXPECT_EQ(end.outcome, "failed");
  EXPECT_TRUE(names(end.message, {"mission runner", "signal 9"}));
}

TEST_F(Session, AProgramThatRefusesItsInputAtTheStartIsBadInput) {
  add("liana-bus", "echo buses.json: rate_hz: 0 >&2; exit 2");
  const RunResult end = RunSession(plan_).run();
  EXPECT_TRUE(end.bad_input);
  EXPECT_NE(end.message.find("rate_hz"), std::string::npos) << end.message;
}

TEST_F(Session, ABenchThatRefusesItsInputEndsTheRunAtOnce) {
  const api::UniqueFd mute = api::listen_at("--api", plan_.api_socket());
  add_living("lianad");
  add("liana-bench", "echo faults.json: drive: 99 >&2; exit 2");
  add_living("liana-mission");
  const auto begin = std::chrono::steady_clock::now();
  const RunResult end = RunSession(plan_).run();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_TRUE(end.bad_input) << end.message;
  EXPECT_LT(took.count(), 10.0) << "of which it waited 14 before";
}

TEST_F(Session, AnInterruptedRunSaysOnlyWhatIsKnownOfTheArm) {
  const FakeDaemon daemon(plan_.api_socket(), true);
  add("lianad", "exec sleep 0.5");
  add("liana-mission", "kill -TERM " + std::to_string(getpid()) + "; exec sleep 60");
  const RunResult end = RunSession(plan_).run();
  EXPECT_EQ(end.outcome, "aborted");
  EXPECT_TRUE(names(end.message, {"lianad", "ENABLED", "0.50 s"}));
}

TEST_F(Session, CtrlCBecomesAStopOfTheArm) {
  const FakeDaemon daemon(plan_.api_socket());
  add("lianad", "exec sleep 0.5");
  add("liana-mission", "kill -INT " + std::to_string(getpid()) + "; exec sleep 60");
  const RunResult end = RunSession(plan_).run();
  EXPECT_EQ(end.outcome, "aborted");
  EXPECT_TRUE(daemon.saw("stop"));
  EXPECT_TRUE(names(end.message, {"interrupted", "DISABLED"}));
}

// A lianad that stands still, and what people see of it.
TEST_F(Session, AProgramThatStandsStillIsNamedAndCtrlCEndsTheRunWithinSeconds) {
  const FakeDaemon daemon(plan_.api_socket(), true);
  add("liana-bench", "kill -STOP $$; exec sleep 60");
  add("lianad", "exec sleep 60");
  add("liana-mission", "sleep 1; kill -INT $PPID; exec sleep 60");
  RunSession session(plan_);
  const auto begin = std::chrono::steady_clock::now();
  const RunResult end = session.run();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_EQ(end.outcome, "aborted");
  EXPECT_LT(took.count(), 8.0) << "of which it waited 26 before";
}

TEST_F(Session, SilenceIsSaidWithWhoStandsStill) {
  const api::UniqueFd mute = api::listen_at("--api", plan_.api_socket());
  add("lianad", "kill -STOP $$");
  add("liana-mission", "sleep 5; kill -INT $PPID; exec sleep 60");
  RunSession session(plan_);
  testing::internal::CaptureStderr();
  session.run();
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(names(said, {"3 s", "lianad", "stopped", "Ctrl-C"}));
}

TEST_F(Session, TheConsoleSaysSilenceToo) {
  const api::UniqueFd mute = api::listen_at("--api", plan_.api_socket());
  add("lianad", "kill -STOP $$");
  ConsoleSession session(plan_);
  session.start();
  testing::internal::CaptureStderr();
  for (const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(4);
       std::chrono::steady_clock::now() < end;) {
    ASSERT_TRUE(session.go_on());
  }
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(names(said, {"3 s", "lianad"}));
}

TEST(Capture, AProgramThatPrintsWithoutEndIsKilled) {
  EXPECT_THROW(run_and_capture({"/bin/sh", "-c", "exec cat /dev/zero"}), std::runtime_error);
  EXPECT_EQ(run_and_capture({"/bin/sh", "-c", "echo little"}).out, "little\n");
}

TEST(Silence, IsBrokenOrSaidAgainAndAgain) {
  std::atomic<int> said = 0;
  {
    Silence silence(0.02, [&](double) { ++said; });
    while (said < 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    silence.broken();
  }
  const int at_end = said;
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_EQ(said, at_end) << "nothing is said afterwards";
}

}  // namespace
}  // namespace liana::launcher
