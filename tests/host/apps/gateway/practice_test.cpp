// A client's faults on their way to the bench, whose end of the socket the test holds.
#include "host/apps/gateway/practice.hpp"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "host/base/net/address.hpp"
#include "host/base/net/socket.hpp"

namespace liana::gateway {
namespace {

class APractice : public testing::Test {
 protected:
  void SetUp() override {
    ::unlink(path_.c_str());
    const sockaddr_un address = api::unix_address(path_);
    listener_ = api::UniqueFd(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    ASSERT_EQ(::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::listen(listener_.get(), 4), 0);
  }
  void TearDown() override { ::unlink(path_.c_str()); }

  // The next packet that the bench reads.
  std::string heard() {
    if (bench_.get() < 0) bench_ = api::UniqueFd(::accept4(listener_.get(), nullptr, nullptr, SOCK_NONBLOCK));
    std::string packet;
    return api::receive_packet(bench_.get(), packet) == api::SocketResult::kDone ? packet : "";
  }
  void says(const std::string& packet) {
    ASSERT_GT(::send(bench_.get(), packet.data(), packet.size(), MSG_NOSIGNAL), 0);
    poller_.run_ready();
  }

  const std::string path_ = testing::TempDir() + "liana_practice_" + std::to_string(::getpid());
  api::UniqueFd listener_, bench_;
  Poller poller_;
  std::vector<Json> answers_;
  Practice practice_{poller_, path_, [this](const Json& answer) { answers_.push_back(answer); }};
};

TEST_F(APractice, PassesFaultsOnAsTheyAreAndAnswersInOrder) {
  practice_.ask(Json::parse(R"({"op":"practice","faults":[{"kind":"slack","drive":5}]})"), 7);
  practice_.ask(Json::parse(R"({"op":"practice","end":true})"), 8);
  EXPECT_EQ(Json::parse(heard()), Json::parse(R"([{"kind":"slack","drive":5}])"));
  EXPECT_EQ(heard(), "\"end\"");
  says(R"({"op":"ok","on":[{"kind":"slack"}]})");
  says(R"({"op":"error","code":"refused","message":"no"})");
  ASSERT_EQ(answers_.size(), 2u);
  EXPECT_EQ(answers_[0], Json::parse(R"({"op":"answer","id":7,"ok":true,"answer":{"on":[{"kind":"slack"}]}})"));
  EXPECT_EQ(answers_[1], Json::parse(R"({"op":"answer","id":8,"ok":false,"code":"refused","message":"no"})"));
}

TEST_F(APractice, RefusesWhatIsNeitherAListNorTheEnd) {
  for (const char* request : {"{}", R"({"faults":{}})", R"({"faults":[],"end":true})", R"({"end":false})"}) {
    practice_.ask(Json::parse(request), 1);
    EXPECT_EQ(answers_.back()["code"], "bad_request") << request;
  }
  Json long_list{{"faults", {std::string(Practice::kMaxBytes - 4, 'x')}}};  // ["x...x"]
  practice_.ask(long_list, 2);
  EXPECT_EQ(heard().size(), Practice::kMaxBytes);
  long_list["faults"] = {std::string(Practice::kMaxBytes - 3, 'x')};
  practice_.ask(long_list, 3);
  EXPECT_EQ(answers_.back()["id"], 3);
  EXPECT_EQ(answers_.back()["code"], "bad_request");
}

TEST_F(APractice, WaitsForSixteenAnswersAndNoMore) {
  for (std::size_t i = 0; i < Practice::kMaxOpen; ++i) practice_.ask(Json::parse(R"({"end":true})"), 1);
  EXPECT_TRUE(answers_.empty());
  practice_.ask(Json::parse(R"({"end":true})"), 2);
  EXPECT_EQ(answers_.back()["code"], "busy");
}

TEST_F(APractice, SaysThatTheBenchHasEnded) {
  practice_.ask(Json::parse(R"({"end":true})"), 1);
  heard();
  bench_ = api::UniqueFd();
  poller_.run_ready();
  EXPECT_EQ(answers_.back()["code"], "away");
  listener_ = api::UniqueFd();
  practice_.ask(Json::parse(R"({"end":true})"), 2);
  EXPECT_EQ(answers_.back()["id"], 2);
  EXPECT_EQ(answers_.back()["code"], "away");
}

TEST_F(APractice, IsNotThereForAnArmThatIsNotSimulated) {
  Practice none(poller_, "", [this](const Json& answer) { answers_.push_back(answer); });
  none.ask(Json::parse(R"({"faults":[]})"), 1);
  EXPECT_EQ(answers_.back()["code"], "refused");
}

}  // namespace
}  // namespace liana::gateway
