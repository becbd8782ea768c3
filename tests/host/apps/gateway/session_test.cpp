// What a session says and refuses without lianad; with lianad: tests/system/gateway_test.py.
#include "host/apps/gateway/session.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "host/apps/gateway/proof.hpp"
#include "host/base/json/json.hpp"

namespace liana::gateway {
namespace {

class ASession : public testing::Test {
 protected:
  Session made() {
    return Session(house_, "127.0.0.1", 0.0, [] {});
  }
  static Json next(Session& session, double now_s = 0.0) {
    const auto message = session.next(now_s);
    return message ? Json::parse(message->bytes) : Json();
  }

  Poller poller_;
  Feed feed_{poller_, "/nowhere", [] {}};
  Tokens tokens_{{"anna", {Access::kOperate, "0123456789abcdef"}}, {"will", {Access::kWatch, "fedcba9876543210"}}};
  std::vector<std::string> refused_;
  House house_{poller_,
               feed_,
               "/nowhere",
               "/nowhere",
               nullptr,
               true,
               [](const std::string& wanted) { return wanted; },
               [this](std::string_view what, const std::string&, std::string_view) { refused_.emplace_back(what); }};
};

TEST_F(ASession, BeginsWithAChallengeAndTellsThatLianadIsAway) {
  Session session = made();
  const Json challenge = next(session);
  EXPECT_EQ(challenge["op"], "challenge");
  EXPECT_EQ(challenge["proof"], false);
  session.take_text(R"({"op":"hello","name":"browser"})", 0.0);
  EXPECT_TRUE(session.is_greeted());
  EXPECT_EQ(next(session)["op"], "away");
  EXPECT_TRUE(next(session).is_null());
}

TEST_F(ASession, TakesTheProofOfItsOwnNonceAndItsTokensName) {
  house_.tokens = &tokens_;
  Session session = made();
  const std::string nonce = next(session)["nonce"];
  session.take_text(Json{{"op", "hello"},
                         {"name", "liana estop"},
                         {"token_name", "anna"},
                         {"proof", proof_of("0123456789abcdef", nonce)}}
                        .dump(),
                    0.0);
  EXPECT_TRUE(session.is_greeted());
  EXPECT_EQ(session.name(), "anna");
  EXPECT_FALSE(session.ticket().empty());
}

TEST_F(ASession, EndsWithTheFirstProofThatIsNone) {
  house_.tokens = &tokens_;
  const std::string good = proof_of("0123456789abcdef", "another nonce");
  for (const Json& proof : {Json(), Json(""), Json(good), Json(7)}) {
    Session session = made();
    session.take_text(Json{{"op", "hello"}, {"token_name", "anna"}, {"proof", proof}}.dump(), 0.0);
    EXPECT_FALSE(session.is_greeted());
    EXPECT_EQ(session.end().code, 1008);
  }
  EXPECT_EQ(refused_, (std::vector<std::string>{"no_token", "no_token", "wrong_proof", "no_token"}));
}

TEST_F(ASession, IsNobodyBeforeItsHello) {
  for (const char* text : {R"({"op":"stop"})", R"({"op":"request","request":{"op":"acquire"}})", R"({"op":7})"}) {
    Session session = made();
    session.take_text(text, 0.0);
    EXPECT_EQ(session.end().code, 1008) << text;
  }
  Session session = made();
  session.tick(4.9);
  EXPECT_EQ(session.end().code, 0);
  session.tick(5.1);
  EXPECT_EQ(session.end().code, 1008);
}

TEST_F(ASession, RefusesNamesThatCouldDeceiveAReader) {
  const std::string names[] = {"", "a\nb", "a\x1b[2J", std::string(33, 'x')};
  for (const std::string& name : names) {
    Session session = made();
    session.take_text(Json{{"op", "hello"}, {"name", name}}.dump(), 0.0);
    EXPECT_FALSE(session.is_greeted());
  }
}

TEST_F(ASession, AnswersFewMalformedMessagesAndEndsWithMany) {
  Session session = made();
  session.take_text(R"({"op":"hello","name":"browser"})", 0.0);
  for (int i = 0; i < 20; ++i) session.take_text(R"({"op":"dance","id":5})", 0.0);
  EXPECT_EQ(session.end().code, 0);
  session.take_text("{", 0.0);
  EXPECT_EQ(session.end().code, 1008);
  next(session);  // challenge
  const Json answer = next(session);
  EXPECT_EQ(answer["id"], 5);
  EXPECT_EQ(answer["code"], "bad_request");
}

TEST_F(ASession, ForgivesMalformedMessagesWithTime) {
  Session session = made();
  session.take_text(R"({"op":"hello","name":"browser"})", 0.0);
  for (int i = 0; i < 100; ++i) session.take_text("{", i);
  EXPECT_EQ(session.end().code, 0);
}

TEST_F(ASession, EndsWhenItsAnswersAreNotRead) {
  Session session = made();
  session.take_text(R"({"op":"hello","name":"browser"})", 0.0);
  const std::string request = R"({"op":"request","id":1,"request":{"op":"hold"}})";
  std::size_t asked = 0;
  while (session.end().code == 0 && asked < 100000) {
    session.take_text(request, 0.0);
    ++asked;
  }
  EXPECT_GT(asked, 1000u);
  EXPECT_LT(asked, 10000u);
}

TEST_F(ASession, SaysEnoughUntilTheNextTick) {
  Session session = made();
  session.take_text(R"({"op":"hello","name":"browser"})", 0.0);
  for (std::size_t i = 1; i < Session::kMaxMessages; ++i) {
    EXPECT_FALSE(session.has_said_much());
    session.take_text(R"({"op":"pace","hz":10})", 0.0);
  }
  EXPECT_TRUE(session.has_said_much());
  session.tick(0.1);
  EXPECT_FALSE(session.has_said_much());
}

}  // namespace
}  // namespace liana::gateway
