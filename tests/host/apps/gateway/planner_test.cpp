// The planner of one client, with a stand-in for `liana` that answers as each test needs it; with the real one:
// tests/page/e2e/console_test.mjs.
#include "host/apps/gateway/planner.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "host/api/server/request_error.hpp"

namespace liana::gateway {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFound =
    R"({"outcome":"solved","waypoints_deg":[[0,0],[1,2]],"checked":{"duration_s":4.5,"min_clearance_m":0.02,"nearest":"wall"}})";

class ThePlanner : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "planner-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    folder_ = name;
    fs::create_directory(folder_ / "tmp");
    before_ = ::getenv("TMPDIR") == nullptr ? "" : ::getenv("TMPDIR");
    ::setenv("TMPDIR", (folder_ / "tmp").c_str(), 1);
    program("cat " + (folder_ / "answer").string());
    answers(kFound);
  }
  void TearDown() override {
    before_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", before_.c_str(), 1);
    fs::remove_all(folder_);
  }

  // What the stand-in does, in words of sh; its arguments are kept.
  void program(const std::string& script) {
    std::ofstream(folder_ / "liana") << "#!/bin/sh\necho \"$@\" > " << (folder_ / "words").string() << "\n" << script;
    ::chmod((folder_ / "liana").c_str(), 0700);
  }
  void answers(const std::string& text) { std::ofstream(folder_ / "answer") << text << "\n"; }

  Planner made() {
    return Planner((folder_ / "liana").string(), [this](const Json& message) { said_.push_back(message); });
  }
  fs::path temporary() const { return folder_ / "tmp"; }
  void start(Planner& planner) { planner.start(request_, welcome_, state_, "anna", 10.0); }
  std::string refusal(Planner& planner) {
    try {
      start(planner);
    } catch (const api::RequestError& error) {
      return error.code();
    }
    return "";
  }
  // Until its process has ended, at most 20 s.
  void wait(Planner& planner) {
    for (int i = 0; i < 4000 && planner.is_running(); ++i) {
      planner.tick(state_, "anna", 10.5);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    ASSERT_FALSE(planner.is_running());
  }
  Json planned() {
    Planner planner = made();
    start(planner);
    wait(planner);
    return said_.empty() ? Json() : said_.back();
  }
  std::string words() const {
    std::ifstream in(folder_ / "words");
    std::string line;
    std::getline(in, line);
    return line;
  }
  bool is_clean() const { return fs::is_empty(folder_ / "tmp"); }

  Json welcome_ = Json::parse(R"({
    "robot":{"name":"arm","kind":"robot","segments":[{"modules":8,"module_length_m":0.1,"theta_limit_deg":20}],
             "limits":{"tip_speed_m_s":0.1,"tip_rate_deg_s":20,"theta_rate_deg_s":2}},
    "scene":{"name":"room","margins":{"prediction_m":0.007,"refuse_m":0.003}}})");
  Json state_ = Json::parse(R"({"owner":"anna","at_rest":true,"is_busy":false,"setpoint_js_deg":[0.125,-3]})");
  Json request_ = Json::parse(R"({"op":"plan","goal_deg":[1,2],"number":7})");
  std::vector<Json> said_;

 private:
  fs::path folder_;
  std::string before_;
};

TEST_F(ThePlanner, FindsAWayFromTheCommandToTheGoalWithTheMarginOfTheScene) {
  const Json way = planned();
  EXPECT_EQ(way["phase"], "found");
  EXPECT_EQ(way["from_deg"], Json::parse("[0.125,-3]"));
  EXPECT_EQ(way["points_deg"], Json::parse("[[0,0],[1,2]]"));
  EXPECT_EQ(way["duration_s"], 4.5);
  EXPECT_EQ(way["min_clearance_m"], 0.02);
  EXPECT_EQ(way["nearest"], "wall");
  EXPECT_NE(words().find("--from-deg=0.125,-3 --to-deg=1,2 --margin=0.010000 --json"), std::string::npos) << words();
  EXPECT_TRUE(is_clean());
}

TEST_F(ThePlanner, RemovesFoldersOfGatewaysThatWereKilledAndNoOthers) {
  const fs::path killed = temporary() / "liana-plan-killed", lives = temporary() / "liana-plan-lives",
                 other = temporary() / "liana-planets";
  for (const fs::path& each : {killed, lives, other}) {
    fs::create_directory(each);
    std::ofstream(each / "robot.json") << "{}";
    std::ofstream(each / "log") << "";
  }
  launcher::hold_new_folder(killed, "").reset();
  launcher::hold_new_folder(other, "").reset();
  const launcher::FolderLock held = launcher::hold_new_folder(lives, "");
  Planner planner = made();
  EXPECT_FALSE(fs::exists(killed));
  EXPECT_TRUE(fs::exists(lives / "robot.json"));
  EXPECT_TRUE(fs::exists(other / "robot.json"));
  program("sleep 20");
  start(planner);
  made();
  EXPECT_TRUE(planner.is_running());
  std::size_t folders = 0;
  for (const fs::directory_entry& each : fs::directory_iterator(temporary()))
    folders += each.path().filename().string().starts_with("liana-plan-") ? 1U : 0U;
  EXPECT_EQ(folders, 2u) << "that of a plan that is being made stays";
}

TEST_F(ThePlanner, SaysNoClearanceWhereNothingIsInTheScene) {
  answers(
      R"({"outcome":"solved","waypoints_deg":[[0,0],[1,2]],"checked":{"duration_s":1,"min_clearance_m":99,"nearest":""}})");
  EXPECT_TRUE(planned()["min_clearance_m"].is_null());
}

TEST_F(ThePlanner, ReadsItsAnswerBetweenLinesOfProgress) {
  answers(std::string("plan: round 1: {}\n") + kFound + "\nplan: clearance is small");
  EXPECT_EQ(planned()["phase"], "found");
}

TEST_F(ThePlanner, SaysInWordsThatThereIsNoWay) {
  answers(R"({"outcome":"infeasible","waypoints_deg":[],"reason":"link 22 is 9 mm from panel","checked":null})");
  const Json said = planned();
  EXPECT_EQ(said["phase"], "none");
  EXPECT_NE(said["text"].text().find("link 22 is 9 mm from panel"), std::string::npos);
}

TEST_F(ThePlanner, SaysWhatAProgramThatFailedSaidLast) {
  const std::string kAnswers[] = {R"({"error":{"exit_code":2,"text":"no such table"}})", "no such table", "{}",
                                  R"({"outcome":"solved"})"};
  for (const std::string& answer : kAnswers) {
    answers(answer);
    EXPECT_EQ(planned()["phase"], "none") << answer;
  }
  program("exec /nonexistent/program");
  EXPECT_EQ(planned()["phase"], "none");
  EXPECT_TRUE(is_clean());
}

TEST_F(ThePlanner, TakesAsManyPointsAsLianadTakesAndNoMore) {
  const auto with = [](std::size_t count) {
    Json plan = Json::parse(kFound);
    plan["waypoints_deg"] = Json::array();
    for (std::size_t i = 0; i < count; ++i) plan["waypoints_deg"].push_back(Json::parse("[0,0]"));
    return plan.dump();
  };
  answers(with(Planner::kMaxPoints));
  EXPECT_EQ(planned()["phase"], "found");
  answers(with(Planner::kMaxPoints + 1));
  EXPECT_EQ(planned()["phase"], "none");
}

TEST_F(ThePlanner, RunsOnceAtATimeAndTellsItsProgressEachSecond) {
  program("echo plan: round 2; exec sleep 60");
  Planner planner = made();
  start(planner);
  EXPECT_EQ(refusal(planner), "busy");
  planner.tick(state_, "anna", 10.9);
  EXPECT_TRUE(said_.empty());
  planner.tick(state_, "anna", 11.0);
  planner.tick(state_, "anna", 11.9);
  ASSERT_EQ(said_.size(), 1u);
  EXPECT_EQ(said_[0]["phase"], "planning");
  EXPECT_EQ(said_[0]["for_s"], 1.0);
}

TEST_F(ThePlanner, EndsWhenItIsCancelled) {
  program("exec sleep 60");
  Planner planner = made();
  planner.end("cancelled");
  EXPECT_TRUE(said_.empty());
  start(planner);
  planner.end("cancelled");
  EXPECT_FALSE(planner.is_running());
  EXPECT_EQ(said_.back()["text"], "cancelled");
  EXPECT_TRUE(is_clean());
}

TEST_F(ThePlanner, EachOfItsMessagesHasTheNumberOfItsGoal) {
  EXPECT_EQ(planned()["number"], 7);
  request_["number"] = 8;
  program("echo plan: round 2; exec sleep 60");
  Planner planner = made();
  start(planner);
  planner.tick(state_, "anna", 11.0);
  EXPECT_EQ(said_.back()["number"], 8);
  request_["number"] = 9;
  EXPECT_EQ(refusal(planner), "busy");
  planner.end("cancelled");
  EXPECT_EQ(said_.back()["number"], 8);
  request_.erase("number");
  EXPECT_EQ(refusal(planner), "bad_request");
}

TEST_F(ThePlanner, EndsAfterItsTime) {
  program("exec sleep 600");
  Planner planner = made();
  start(planner);
  planner.tick(state_, "anna", 10.0 + Planner::kPatience_s);
  EXPECT_TRUE(planner.is_running());
  planner.tick(state_, "anna", 10.1 + Planner::kPatience_s);
  EXPECT_FALSE(planner.is_running());
  EXPECT_EQ(said_.back()["phase"], "none");
}

TEST_F(ThePlanner, IsForTheOwnerOfMotionAloneAndEndsWithThat) {
  program("exec sleep 60");
  Planner planner = made();
  for (const char* owner : {"", "ben"}) {
    state_["owner"] = owner;
    EXPECT_EQ(refusal(planner), "not_owner");
  }
  state_["owner"] = "anna";
  start(planner);
  state_["owner"] = "ben";
  planner.tick(state_, "anna", 10.1);
  EXPECT_FALSE(planner.is_running());
  EXPECT_EQ(said_.back()["phase"], "none");
  state_["owner"] = "anna";
  start(planner);
  planner.tick(Json(), "anna", 10.1);  // lianad has left
  EXPECT_FALSE(planner.is_running());
}

TEST_F(ThePlanner, BeginsFromRestAlone) {
  Planner planner = made();
  state_["at_rest"] = false;
  EXPECT_EQ(refusal(planner), "refused");
  state_["at_rest"] = true;
  state_["is_busy"] = true;
  EXPECT_EQ(refusal(planner), "refused");
  state_["is_busy"] = false;
  state_["setpoint_js_deg"] = Json();
  EXPECT_EQ(refusal(planner), "refused");
  state_ = Json();
  EXPECT_EQ(refusal(planner), "away");
}

TEST_F(ThePlanner, RefusesGoalsThatAreNoneOfThisArm) {
  Planner planner = made();
  for (const char* goal : {"[1]", "[1,2,3]", "\"zero\"", "[1,null]", "null"}) {
    request_["goal_deg"] = Json::parse(goal);
    EXPECT_EQ(refusal(planner), "bad_request") << goal;
  }
  request_["goal_deg"] = Json::parse("[1,20.1]");
  EXPECT_EQ(refusal(planner), "out_of_range");
  EXPECT_TRUE(is_clean());
}

}  // namespace
}  // namespace liana::gateway
