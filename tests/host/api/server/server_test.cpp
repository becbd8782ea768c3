// Sessions, malformed input, queues and lockstep over real sockets.
#include "host/api/server/server.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <thread>

#include "host/api/server/client.hpp"
#include "host/api/server/request_error.hpp"
#include "host/base/json/json.hpp"

namespace liana::api {
namespace {

class Recorder : public ApiHandler {
 public:
  Json welcome(const ClientInfo&) override { return {{"op", "welcome"}}; }
  Json handle(const ClientInfo& client, const Json& request) override {
    log.push_back(client.name + ":" + request.at("op").get<std::string>());
    if (request["op"] == "refuse") throw RequestError("refused", "because");
    return {{"extra", 1}};
  }
  void gone(const ClientInfo& client, const std::string&) override { log.push_back(client.name + " gone"); }
  std::vector<std::string> log;
};

class Api : public testing::Test {
 protected:
  Api() : path_(testing::TempDir() + "liana_api_" + std::to_string(::getpid())), server_(path_, recorder_) {}
  ~Api() override { ::unlink(path_.c_str()); }

  ApiClient join(const std::string& name, const std::string& role, bool lockstep = false, Json topics = Json::array()) {
    ApiClient client = ApiClient::connect(path_);
    client.send({{"op", "hello"}, {"name", name}, {"role", role}, {"lockstep", lockstep}, {"subscribe", topics}});
    EXPECT_EQ(answer(client).value("op", ""), "welcome");
    return client;
  }
  // What the client hears next.
  Json answer(ApiClient& client) {
    for (int i = 0; i < 50; ++i) {
      server_.pump(0.001);
      server_.dispatch();
      if (auto message = client.receive(0.0)) return *message;
    }
    return Json::object();
  }
  Json raw(ApiClient& client, const std::string& bytes) {
    EXPECT_EQ(send_packet(client.fd(), bytes), SocketResult::kDone);
    return answer(client);
  }

  Recorder recorder_;
  std::string path_;
  ApiServer server_;
};

TEST_F(Api, MalformedInputIsAnsweredWithAnErrorAndTheClientStays) {
  ApiClient client = join("c", "client");
  const std::vector<std::string> malformed{"{",
                                           "[]",
                                           "42",
                                           "null",
                                           "{\"op\":\"x\",}",
                                           "\xff\xfe",
                                           "{\"op\":\"done\"}",
                                           "{\"op\":\"done\",\"tick\":\"now\"}",
                                           "{\"op\":\"x\",\"id\":\"seven\"}",
                                           "{\"op\":\"hello\",\"name\":\"again\",\"role\":\"client\"}",
                                           std::string(60000, '['),
                                           std::string(140000, 'x')};
  for (const std::string& bytes : malformed) {
    const Json error = raw(client, bytes);
    EXPECT_EQ(error.value("op", ""), "error") << bytes.substr(0, 40);
    EXPECT_EQ(error.value("code", ""), "bad_request") << bytes.substr(0, 40);
    EXPECT_NE(error.value("message", ""), "");
  }
  EXPECT_EQ(raw(client, R"({"op":"fine","id":3})"), Json({{"op", "ok"}, {"id", 3}, {"extra", 1}}));
}

TEST_F(Api, ANumberThatNoDoubleHoldsIsAnsweredWithItsFieldAndIsOutOfRange) {
  ApiClient client = join("c", "client");
  const char* rows[][2] = {{R"({"op":"fine","a":1e999})", "a: 1e999: allowed"},
                           {R"({"op":"fine","goal_deg":[0,-1e400],"id":4})", "goal_deg[1]: -1e400: allowed"},
                           {R"({"op":"fine","push":{"gains":[{"mass_kg":1e400}]}})", "push.gains[0].mass_kg: 1e400: "}};
  for (const auto& [bytes, start] : rows) {
    const Json error = raw(client, bytes);
    EXPECT_EQ(error.value("op", ""), "error") << bytes;
    EXPECT_EQ(error.value("code", ""), "out_of_range") << bytes;
    EXPECT_TRUE(error.value("message", "").starts_with(start)) << error;
  }
  EXPECT_EQ(raw(client, R"({"op":"fine","id":3})"), Json({{"op", "ok"}, {"id", 3}, {"extra", 1}}));
}

TEST_F(Api, NothingIsDoneBeforeHello) {
  ApiClient client = ApiClient::connect(path_);
  EXPECT_EQ(raw(client, R"({"op":"stop"})").value("code", ""), "bad_request");
  EXPECT_EQ(raw(client, R"({"op":"hello","name":"x","role":"king"})").value("code", ""), "bad_request");
  EXPECT_EQ(raw(client, R"({"op":"hello","role":"client"})").value("code", ""), "bad_request");
  EXPECT_EQ(raw(client, R"({"op":"hello","name":"a\n999","role":"client"})").value("code", ""), "bad_request");
  EXPECT_EQ(raw(client, R"({"op":"hello","name":"x","role":"client","lockstp":true})").value("code", ""),
            "bad_request");
  EXPECT_EQ(raw(client, R"({"op":"hello","name":"x","role":"client","subscribe":["weather"]})").value("code", ""),
            "bad_request");
  EXPECT_TRUE(recorder_.log.empty());
}

TEST_F(Api, ARefusalCarriesCodeAndId) {
  ApiClient client = join("c", "client");
  const Json error = raw(client, R"({"op":"refuse","id":9})");
  EXPECT_EQ(error, Json({{"op", "error"}, {"id", 9}, {"code", "refused"}, {"message", "because"}}));
}

TEST_F(Api, ClientsAreServedByRoleWhateverOrderTheyCameIn) {
  ApiClient watcher = join("w", "observer"), op = join("o", "operator"), mission = join("m", "mission");
  watcher.send({{"op", "one"}});
  op.send({{"op", "two"}});
  mission.send({{"op", "three"}});
  for (int i = 0; i < 5; ++i) server_.pump(0.001);
  server_.dispatch();
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"m:three", "o:two", "w:one"}));
}

TEST_F(Api, TheLastRequestsOfADeadClientAreHeardBeforeItsDeath) {
  {
    ApiClient client = join("c", "client");
    client.send({{"op", "stop"}});
  }
  for (int i = 0; i < 5; ++i) server_.pump(0.001);
  server_.dispatch();
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"c:stop", "c gone"}));
}

TEST_F(Api, ASlowObserverLosesOldStatesAndHoldsNobodyUp) {
  ApiClient slow = join("slow", "observer", false, {"state"});
  const std::string filler(4000, ' ');
  const auto is_change = [](int i) { return i == 500 || i == 501; };
  for (int i = 0; i < 1000; ++i)
    server_.publish(Topic::kState, Json({{"op", "state"}, {"tick", i}}).dump() + filler, is_change(i));
  EXPECT_GT(server_.dropped(), 0u);
  std::vector<int> ticks;
  std::thread reader([&] {
    for (auto state = slow.receive(5.0); state; state = slow.receive(0.5)) ticks.push_back(state->value("tick", -1));
  });
  server_.deliver(10.0);
  reader.join();
  ASSERT_FALSE(ticks.empty());
  EXPECT_TRUE(std::is_sorted(ticks.begin(), ticks.end()));
  EXPECT_EQ(std::count_if(ticks.begin(), ticks.end(), is_change), 2) << "what is to be kept arrives";
  EXPECT_EQ(ticks.back(), 999) << "the newest state arrives";
}

class ApiEvents : public Api {
 protected:
  void publish(int count, std::size_t filler = 0) {
    for (int i = 0; i < count; ++i) {
      const Json event{{"op", "event"}, {"sequence", ++published_}, {"text", std::string(filler, 'x')}};
      server_.publish_event(event.dump());
    }
  }
  ApiClient reader(Json from = nullptr) {
    ApiClient client = ApiClient::connect(path_);
    Json hello{{"op", "hello"}, {"name", "r"}, {"role", "observer"}, {"subscribe", {"event"}}};
    if (!from.is_null()) hello["events_from"] = from;
    client.send(hello);
    welcome_ = answer(client);
    return client;
  }
  // All that a reader gets by the end of it.
  std::vector<Json> read_all(ApiClient& client) {
    std::vector<Json> out;
    for (int silent = 0; silent < 3; ++silent) {
      server_.pump(0.0);
      while (auto message = client.receive(0.0)) {
        out.push_back(*message);
        silent = 0;
        server_.pump(0.0);
      }
    }
    return out;
  }
  // Every event from `first` on, in order and once; `lost` of them, as the reader is told.
  void expect_all_from(int first, const std::vector<Json>& heard, int& lost) const {
    int next = first;
    lost = 0;
    for (const Json& message : heard) {
      if (message.value("op", "") == "events_lost") {
        EXPECT_EQ(message["from"], next);
        EXPECT_EQ(message["count"], message["to"].get<int>() - next + 1);
        lost += message["count"].get<int>();
        next = message["to"].get<int>() + 1;
      } else {
        ASSERT_EQ(message.value("sequence", 0), next);
        ++next;
      }
    }
    EXPECT_EQ(next, published_ + 1) << "the newest arrives";
  }

  int published_ = 0;
  Json welcome_;
};

TEST_F(ApiEvents, ASubscriberGetsEachOnceAndOthersNone) {
  publish(3);
  ApiClient first = reader();
  EXPECT_EQ(welcome_["events"], Json({{"oldest", 1}, {"next", 4}}));
  ApiClient other = join("other", "observer", false, {"state"});
  publish(50);
  int lost = 0;
  expect_all_from(4, read_all(first), lost);
  EXPECT_EQ(lost, 0);
  EXPECT_FALSE(other.receive(0.0));
}

TEST_F(ApiEvents, AReaderThatIsSlowForLongLosesNoneThatAreKept) {
  ApiClient slow = reader();
  publish(4000, 300);
  int lost = 0;
  expect_all_from(1, read_all(slow), lost);
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(server_.dropped(), 0u);
}

TEST_F(ApiEvents, AReaderThatIsSlowForTooLongIsToldHowManyAreGone) {
  ApiClient slow = reader();
  publish(20000, 300);
  const std::vector<Json> heard = read_all(slow);
  int lost = 0;
  expect_all_from(1, heard, lost);
  EXPECT_GT(lost, 10000);
  EXPECT_LE(lost, 20000 - static_cast<int>(PacketHistory::kKept));
  publish(5);
  EXPECT_EQ(read_all(slow).size(), 5u) << "it goes on where it is";
}

TEST_F(ApiEvents, WhoComesBackAsksForWhatItHasNotSeen) {
  publish(100);
  ApiClient again = reader(41);
  int lost = 0;
  expect_all_from(41, read_all(again), lost);
  EXPECT_EQ(lost, 0);
  publish(5000);
  ApiClient late = reader(41);
  expect_all_from(41, read_all(late), lost);
  EXPECT_EQ(lost, 5100 - static_cast<int>(PacketHistory::kKept) - 40);
}

TEST_F(ApiEvents, ANumberThatIsNotThereYetWasLearnedFromAnotherLianad) {
  publish(10);
  ApiClient next = reader(11);
  EXPECT_EQ(welcome_.value("op", ""), "welcome");
  ApiClient beyond = reader(12);
  EXPECT_EQ(welcome_.value("code", ""), "out_of_range");
  EXPECT_NE(welcome_.value("message", "").find("events_from"), std::string::npos);
  for (const Json& wrong : {Json(0), Json(-1), Json("all"), Json(1.5)}) {
    ApiClient client = reader(wrong);
    EXPECT_EQ(welcome_.value("op", ""), "error") << wrong;
  }
}

TEST_F(Api, LockstepWaitsForDoneOfThisTick) {
  ApiClient client = join("m", "mission", true);
  std::thread answering([&] {
    client.send({{"op", "done"}, {"tick", 4}});  // of an earlier state: does not count
    ::usleep(20000);
    client.send({{"op", "move"}});
    client.send({{"op", "done"}, {"tick", 5}});
  });
  server_.wait_done(5, 10.0);
  answering.join();
  server_.dispatch();
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"m:move"}));
}

TEST_F(Api, WhatALockstepClientSendsAfterItsDoneBelongsToTheNextInterval) {
  auto client = std::make_unique<ApiClient>(join("m", "mission", true));
  client->send({{"op", "done"}, {"tick", 5}});
  client->send({{"op", "late"}});
  client.reset();
  server_.wait_done(5, 10.0);
  server_.pump(0.01);
  server_.dispatch();
  EXPECT_TRUE(recorder_.log.empty()) << "neither the request nor the end of the client";
  server_.wait_done(10, 10.0);
  server_.dispatch();
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"m:late", "m gone"}));
}

TEST_F(Api, ALockstepClientThatLeavesWithoutItsAnswerBelongsToTheNextIntervalToo) {
  auto client = std::make_unique<ApiClient>(join("m", "mission", true));
  client->send({{"op", "move"}, {"id", 1}});
  client->send({{"op", "done"}, {"tick", 5}});
  server_.wait_done(5, 10.0);
  client.reset();
  server_.dispatch();
  server_.publish(Topic::kState, R"({"op":"state","tick":10})");
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"m:move"}))
      << "its answer and the next state meet a closed socket";
  server_.wait_done(10, 10.0);
  server_.dispatch();
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"m:move", "m gone"}));
}

TEST_F(Api, TheLastRequestOfAClientThatLeavesUnreadStatesIsHeard) {
  {
    ApiClient client = join("c", "client", false, {"state"});
    server_.publish(Topic::kState, R"({"op":"state","tick":5})");
    client.send({{"op", "stop"}});
  }
  for (int i = 0; i < 5; ++i) server_.pump(0.001);
  server_.dispatch();
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"c:stop", "c gone"}));
}

TEST_F(Api, ASilentLockstepClientIsDroppedAndNamed) {
  ApiClient client = join("m", "mission", true);
  server_.wait_done(5, 0.05);
  server_.dispatch();
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"m gone"}));
  EXPECT_THROW(client.receive(1.0), std::runtime_error);
}

TEST_F(Api, SilentConnectionsMakeRoomForTheNewest) {
  std::vector<ApiClient> silent;
  for (int i = 0; i < 100; ++i) {
    silent.push_back(ApiClient::connect(path_));
    server_.pump(0.001);
  }
  ApiClient client = join("liana estop", "observer");
  EXPECT_EQ(raw(client, R"({"op":"stop","id":1})").value("op", ""), "ok");
  EXPECT_THROW(silent.front().receive(1.0), std::runtime_error);
  silent.back().send({{"op", "hello"}, {"name", "late"}, {"role", "client"}});
  EXPECT_EQ(answer(silent.back()).value("op", ""), "welcome") << "the newest of the silent ones has its place";
}

TEST_F(Api, AConnectionThatNeverSaysHelloIsDropped) {
  ApiClient silent = ApiClient::connect(path_);
  for (int i = 0; i < 25; ++i) {
    server_.pump(0.1);
    ::usleep(100000);
  }
  EXPECT_THROW(silent.receive(0.0), std::runtime_error);
}

TEST_F(Api, AStopIsHeardThoughEveryPlaceIsTaken) {
  std::vector<ApiClient> clients;
  for (int i = 0; i < 32; ++i) clients.push_back(join("c" + std::to_string(i), "client"));
  ApiClient late = ApiClient::connect(path_);
  late.send({{"op", "hello"}, {"name", "late"}, {"role", "observer"}});
  late.send({{"op", "move"}, {"id", 1}});
  late.send({{"op", "stop"}, {"id", 2}});
  EXPECT_EQ(answer(late).value("code", ""), "busy");
  EXPECT_EQ(answer(late).value("code", ""), "busy");
  EXPECT_EQ(answer(late), Json({{"op", "ok"}, {"id", 2}, {"extra", 1}}));
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"late:stop"}));
}

// Leaves this process so many descriptors beside those that it has, until it goes.
class FewDescriptors {
 public:
  explicit FewDescriptors(int left) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const UniqueFd next(::dup(0));
    rlimit few = before_;
    few.rlim_cur = static_cast<rlim_t>(next.get() + left);
    ::setrlimit(RLIMIT_NOFILE, &few);
  }
  ~FewDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

// A process beside the server's, with descriptors of its own; ended when this goes.
class Beside {
 public:
  explicit Beside(const std::function<int()>& work) : child_(::fork()) {
    if (child_ != 0) return;
    rlimit most{};
    ::getrlimit(RLIMIT_NOFILE, &most);
    most.rlim_cur = most.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &most);
    ::_exit(work());
  }
  ~Beside() {
    if (!has_ended()) ::kill(child_, SIGKILL), ::waitpid(child_, &status_, 0);
  }
  bool has_ended() { return ended_ = ended_ || ::waitpid(child_, &status_, WNOHANG) == child_; }
  bool is_good() const { return WIFEXITED(status_) && WEXITSTATUS(status_) == 0; }

 private:
  ::pid_t child_;
  int status_ = 1;
  bool ended_ = false;
};

// 60 connections that are made anew whenever they are closed.
int crowd(const std::string& path, const std::string& first_packet) {
  std::vector<UniqueFd> ends(60);
  for (std::string heard;; ::usleep(1000)) {
    for (UniqueFd& end : ends) {
      if (end.get() >= 0 && receive_packet(end.get(), heard) != SocketResult::kClosed) continue;
      end = try_to_connect(path);
      if (end.get() >= 0 && !first_packet.empty()) send_packet(end.get(), first_packet);
    }
  }
}

// As `liana estop` does it; 0 when the stop was confirmed within a second.
int stop_within_a_second(const std::string& path) {
  UniqueFd end;
  for (int i = 0; i < 500; ++i, ::usleep(2000)) {
    std::string packet;
    const SocketResult result = end.get() < 0 ? SocketResult::kClosed : receive_packet(end.get(), packet);
    if (packet.find(R"("id":1)") != std::string::npos) return packet.find(R"("op":"ok")") == std::string::npos ? 1 : 0;
    if (result != SocketResult::kClosed) continue;
    end = try_to_connect(path);
    if (end.get() < 0) continue;
    send_packet(end.get(), R"({"op":"hello","name":"estop","role":"observer"})");
    send_packet(end.get(), R"({"op":"stop","id":1})");
  }
  return 1;
}

TEST_F(Api, AStopIsHeardAndAnsweredThoughOthersTakeEveryDescriptor) {
  for (const int left : {0, 1, 6, 20}) {
    for (const std::string packet : {"", R"({"op":"hello","name":"s","role":"client"})"}) {
      SCOPED_TRACE(std::to_string(left) + " left, each says '" + packet + "'");
      const FewDescriptors few(left);
      const auto serve = [&] { server_.pump(0.001), server_.dispatch(); };
      Beside strangers([&] { return crowd(path_, packet); });
      for (int i = 0; i < 100; ++i) serve();
      Beside stop([&] { return stop_within_a_second(path_); });
      for (int i = 0; i < 3000 && !stop.has_ended(); ++i) serve();
      EXPECT_TRUE(stop.is_good());
    }
  }
}

TEST_F(Api, WhoNeitherSendsNorReadsIsSilent) {
  ApiClient reader = join("1", "observer", false, {"state"}), sender = join("2", "observer"),
            stuck = join("3", "observer", false, {"state"});
  const std::string state = R"({"op":"state","x":")" + std::string(20000, 'x') + "\"}";
  for (int i = 0; i < 40; ++i) {
    server_.publish(Topic::kState, state);
    while (reader.receive(0.0)) {
    }
    sender.send({{"op", "fine"}});
    server_.pump(0.0);
    server_.dispatch();
    ::usleep(10000);
  }
  EXPECT_LT(server_.silence_s(1), 0.1);
  EXPECT_LT(server_.silence_s(2), 0.1);
  EXPECT_GE(server_.silence_s(3), 0.4);
  EXPECT_EQ(server_.silence_s(99), 0.0);
  while (stuck.receive(0.0)) {
  }
  server_.publish(Topic::kState, state);
  EXPECT_LT(server_.silence_s(3), 0.1) << "it reads on";
}

TEST_F(Api, AStopIsReadWhileOthersFlood) {
  std::vector<ApiClient> flooding;
  for (int i = 0; i < 28; ++i) flooding.push_back(join("f" + std::to_string(i), "observer"));
  std::string numbers = "[0";
  for (int i = 0; i < 30000; ++i) numbers += ",1";
  const std::string large = R"({"op":"move","x":)" + numbers + "]}";
  const auto flood = [&] {
    for (const ApiClient& client : flooding) {
      while (send_packet(client.fd(), large) == SocketResult::kDone) {
      }
    }
  };
  for (int i = 0; i < 20; ++i) {
    flood();
    server_.pump(0.001);
    server_.dispatch();
  }
  flood();
  ApiClient client = ApiClient::connect(path_);
  client.send({{"op", "hello"}, {"name", "estop"}, {"role", "observer"}});
  client.send({{"op", "stop"}, {"id", 1}});
  const auto heard = [&] { return std::count(recorder_.log.begin(), recorder_.log.end(), "estop:stop") == 1; };
  int pumps = 0;
  for (; pumps < 3 && !heard(); ++pumps) server_.pump(0.001);
  EXPECT_TRUE(heard()) << pumps;
  server_.dispatch();
  EXPECT_EQ(client.receive(1.0).value_or(Json()).value("op", ""), "welcome");
}

TEST_F(Api, AStopIsHandledWhileALockstepClientIsAwaited) {
  ApiClient late = join("m", "mission", true), watcher = join("w", "observer");
  watcher.send({{"op", "stop"}});
  server_.wait_done(5, 0.05);
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"w:stop"}));
}

TEST_F(Api, ARoleThatOneHasIsRefusedToOthersByNameUntilItLeaves) {
  for (const std::string role : {"mission", "operator", "camera", "archive"}) {
    auto first = std::make_unique<ApiClient>(join("first", role));
    ApiClient second = ApiClient::connect(path_);
    const Json hello{{"op", "hello"}, {"name", "second"}, {"role", role}};
    second.send(hello);
    const Json refused = answer(second);
    EXPECT_EQ(refused.value("code", ""), "busy");
    EXPECT_NE(refused.value("message", "").find("'first' has it (process " + std::to_string(::getpid())),
              std::string::npos)
        << refused;
    EXPECT_FALSE(second.receive(0.0));
    first.reset();
    second.send(hello);
    EXPECT_EQ(answer(second).value("op", ""), "welcome") << role;
  }
  join("a", "client"), join("b", "client"), join("c", "observer"), join("d", "observer");
}

TEST_F(Api, ARoleIsFreeAsSoonAsItsClientHasLeftAlsoWhereThatIsReadLater) {
  auto first = std::make_unique<ApiClient>(join("first", "mission", true));
  first->send({{"op", "done"}, {"tick", 5}});
  server_.wait_done(5, 10.0);
  first.reset();  // in lockstep time its end belongs to the next interval
  join("second", "mission");
}

TEST_F(Api, TickRecordsAreForTheArchive) {
  ApiClient curious = ApiClient::connect(path_);
  curious.send({{"op", "hello"}, {"name", "c"}, {"role", "client"}, {"subscribe", {"state", "tick"}}});
  EXPECT_EQ(answer(curious).value("code", ""), "bad_request");
  join("a", "archive", false, {"tick"});
}

TEST_F(Api, WhoReadsNothingIsClosedBeforeMuchIsKeptForHim) {
  ApiClient client = join("c", "client");
  const std::string request = R"({"op":"refuse","id":9})";
  std::size_t asked = 0;
  const auto is_gone = [&] { return !recorder_.log.empty() && recorder_.log.back() == "c gone"; };
  for (; asked < 100000 && !is_gone(); ++asked) {
    send_packet(client.fd(), request);
    server_.pump(0.0);
    server_.dispatch();
  }
  EXPECT_TRUE(is_gone()) << "its answers are over 512 KiB by then";
  EXPECT_GT(asked, 3000u);
}

TEST_F(Api, LargeRequestsWaitInTheirOwnSocketWhenAQuarterOfAMegabyteWaitsForTheInterval) {
  ApiClient client = join("c", "client", true);
  const std::string large = R"({"op":"move","x":")" + std::string(100000, 'x') + R"("})";
  int sent = 0;
  for (int i = 0; i < 200; ++i) {
    sent += send_packet(client.fd(), large) == SocketResult::kDone ? 1 : 0;
    server_.pump(0.0);
  }
  EXPECT_GE(sent, 3);
  EXPECT_LT(sent, 8);
  server_.dispatch();
  EXPECT_EQ(std::count(recorder_.log.begin(), recorder_.log.end(), "c:move"), 3);
}

TEST_F(Api, AnErrorAboutALongTextIsShort) {
  ApiClient client = join("c", "client");
  for (const std::string& bytes : {'"' + std::string(100000, 'x'), R"({"op":")" + std::string(100000, 'x') + R"("})",
                                   R"({"op":"x",")" + std::string(100000, '\x01') + R"(":1})"}) {
    EXPECT_LT(raw(client, bytes).dump(-1, Json::BadUtf8::kReplace).size(), 500u);
  }
}

TEST_F(Api, ALockstepClientThatIsAlwaysLateIsDroppedThoughItAnswersEveryTime) {
  ApiClient client = join("m", "mission", true);
  std::thread answering([&] {
    for (int tick = 1; tick <= 3; ++tick) {
      ::usleep(900000);
      client.send({{"op", "done"}, {"tick", tick}});
    }
  });
  for (std::uint64_t tick = 1; tick <= 3; ++tick) server_.wait_done(tick, 1.5);
  answering.join();
  server_.dispatch();
  EXPECT_EQ(recorder_.log, (std::vector<std::string>{"m gone"})) << "0.4 s each beyond what is free";
}

TEST_F(Api, OnlyItsUserMayConnectWhateverTheUmask) {
  const mode_t before = ::umask(0);
  const std::string path = path_ + "_open";
  {
    ApiServer server(path, recorder_);
    EXPECT_EQ(std::filesystem::status(path).permissions(),
              std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  }
  {
    ApiServer server(path + "_group", recorder_, ::getgid());
    EXPECT_EQ(static_cast<unsigned>(std::filesystem::status(path + "_group").permissions()), 0660u);
  }
  ::umask(before);
  for (const std::string& made : {path, path + "_group"}) ::unlink(made.c_str());
}

TEST_F(Api, ASecondServerOnTheSamePathIsRefused) {
  EXPECT_THROW(ApiServer(path_, recorder_), std::runtime_error);
  EXPECT_THROW(ApiServer(std::string(200, 'x'), recorder_), std::runtime_error);
  EXPECT_THROW(ApiServer("/nonexistent/folder/api", recorder_), std::runtime_error);
}

TEST_F(Api, AFileThatIsNoSocketStays) {
  const std::string file = path_ + "_file";
  std::ofstream(file) << "precious";
  EXPECT_THROW(ApiServer(file, recorder_), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_regular_file(file));
  std::filesystem::remove(file);
}

TEST_F(Api, AClientWithoutAServerIsToldSo) {
  EXPECT_THROW(ApiClient::connect(path_ + "_none", 0.05), std::runtime_error);
}

}  // namespace
}  // namespace liana::api
