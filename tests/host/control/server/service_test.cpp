// The service side over its real socket, with an arm that has ideal drives.
#include "host/control/server/service.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <map>
#include <memory>
#include <thread>

#include "host/api/device/driver.hpp"
#include "host/api/server/client.hpp"
#include "host/api/server/request_table.hpp"
#include "host/api/server/request_text.hpp"
#include "host/control/server/cable_arm_server.hpp"
#include "tests/host/api/server/robots.hpp"
#include "tests/host/control/verification/sim_arm.hpp"
#include "tests/message.hpp"

namespace liana::server {

using namespace cable;
namespace {

ServiceConfig config_for(const verification::SimArm& arm, timing::TimeMode mode) {
  ServiceConfig config;
  config.time_mode = mode;
  config.api_path = testing::TempDir() + "liana_service_" + std::to_string(::getpid());
  config.robot_json = api::zhu2022_json().dump();
  config.scene_json = config.buses.canonical_json = "{}";
  config.camera_latency_s = 0.1;
  config.buses.rate_hz = 1.0 / arm.table().tick_s;
  config.buses.command_interval_s = arm.table().interval_ticks * arm.table().tick_s;
  config.serials = [] { return std::vector<std::uint32_t>(15, 7); };
  config.boot_problems = [] {
    return std::vector<realtime::BootProblem>{{3, FaultNumber::kDriveMissing, "node 4 on can0: silent"}};
  };
  return config;
}

config::RobotConfig robot_of(const verification::SimArm& arm) {
  config::RobotConfig robot;
  robot.table = arm.table();
  return robot;
}

class ServiceOverSocket : public testing::Test {
 protected:
  explicit ServiceOverSocket(timing::TimeMode mode = timing::TimeMode::kFast)
      : arm_(std::make_unique<verification::SimArm>()),
        config_(config_for(*arm_, mode)),
        desk_(robot_of(*arm_), config::SceneConfig{}, "", mode, arm_->link,
              {device::devices_path(config_.api_path), std::nullopt}),
        service_(config_, desk_) {}
  ~ServiceOverSocket() override { ::unlink(config_.api_path.c_str()); }

  api::ApiClient join(const std::string& role, Json topics = {"state"}) {
    api::ApiClient client = api::ApiClient::connect(config_.api_path);
    client.send({{"op", "hello"}, {"name", role}, {"role", role}, {"subscribe", topics}});
    service_.idle(0.01);
    service_.idle(0.0);
    EXPECT_EQ(client.receive(1.0).value_or(Json()).value("op", ""), "welcome");
    return client;
  }
  void intervals(int count) {
    for (int i = 0; i < count; ++i) {
      service_.cycle();
      arm_->interval();
    }
  }
  // The answer to a request; "ok" or an error code.
  std::string ask(api::ApiClient& client, Json request) {
    const Json answer = full_answer(client, std::move(request));
    return answer["op"] == "ok" ? "ok" : answer.value("code", "no answer");
  }
  Json full_answer(api::ApiClient& client, Json request) {
    request["id"] = ++id_;
    client.send(request);
    for (int i = 0; i < 500; ++i) {
      service_.idle(0.001);
      const auto message = client.receive(0.0);
      if (message && message->value("id", 0) == id_) return *message;
    }
    return {{"op", "none"}};
  }
  Json state(api::ApiClient& client) {
    intervals(1);
    Json newest;
    for (int idle = 0; idle < 2;
         ++idle) {  // a client that has not read for long has more waiting in the daemon than in its socket
      service_.idle(0.0);
      while (const auto message = client.receive(0.0)) {
        if ((*message)["op"] == "state") newest = *message;
        service_.idle(0.0);
      }
    }
    return newest;
  }
  void enable(api::ApiClient& mission) {
    ASSERT_EQ(ask(mission, {{"op", "acquire"}}), "ok");
    intervals(10);
    ASSERT_EQ(ask(mission, {{"op", "state_command"}, {"command", "enable"}}), "ok");
    for (int i = 0; i < 400 && arm_->now().state != OperatingState::kEnabled; ++i) intervals(1);
    state(mission);
    ASSERT_EQ(state(mission)["state"], "ENABLED");
  }
  // A device that has said hello, and is heard.
  device::Driver plug_in(const device::Capability& capability) {
    device::Driver driver = device::Driver::connect(device::devices_path(config_.api_path), capability, 0, 0.0);
    service_.idle(0.0);
    return driver;
  }
  Json move_request(double change_deg) const {
    Json goal = theta_deg(arm_->table(), arm_->now().theta_command_rad);
    goal[0] = goal[0].get<double>() + change_deg;
    return {{"op", "move_jp"}, {"goal_deg", goal}};
  }

  std::unique_ptr<verification::SimArm> arm_;
  ServiceConfig config_;
  CableArmServer desk_;
  Service service_;
  int id_ = 0;
};

// req:A20
TEST_F(ServiceOverSocket, AMoveGoesThroughVerificationToTheArm) {
  api::ApiClient mission = join("mission");
  enable(mission);
  const double before = arm_->now().theta_command_rad[0];
  ASSERT_EQ(ask(mission, move_request(0.2)), "ok");
  const Json moving = state(mission);
  EXPECT_TRUE(moving["is_busy"]);
  for (int i = 0; i < 400 && state(mission)["is_busy"]; ++i) {
  }
  const Json done = state(mission);
  EXPECT_NEAR(arm_->now().theta_command_rad[0], before + 0.2 * 0.017453292519943295, 1e-6);
  EXPECT_TRUE(done["verdict"]["released"]);
  EXPECT_EQ(done["refusals"], 0);
  EXPECT_TRUE(done["at_rest"]);
}

TEST_F(ServiceOverSocket, APathIsOneMotionThroughItsPointsAndNamesItself) {
  api::ApiClient mission = join("mission");
  enable(mission);
  Json points = Json::array();
  for (const double change_deg : {0.0, 0.2, 0.1}) points.push_back(move_request(change_deg)["goal_deg"]);
  ASSERT_EQ(ask(mission, {{"op", "move_path"}, {"points_deg", points}}), "ok");
  const Json moving = state(mission);
  EXPECT_EQ(moving["path"]["hash"].get<std::string>().size(), 64u);
  EXPECT_LT(moving["path"]["share"].get<double>(), 0.1);
  for (int i = 0; i < 2000 && state(mission)["is_busy"]; ++i) {
  }
  const Json done = state(mission);
  EXPECT_EQ(done["path"], Json());
  EXPECT_EQ(done["refusals"], 0);
  EXPECT_NEAR(done["setpoint_js_deg"][0].get<double>(), points[2][0].get<double>(), 1e-6);
  const std::string events = done["events"].dump();
  EXPECT_NE(events.find("path " + moving["path"]["hash"].get<std::string>() + " begins"), std::string::npos) << events;
  EXPECT_NE(events.find("has arrived"), std::string::npos) << events;
}

// req:C9 req:C12
TEST_F(ServiceOverSocket, APathThatLeadsTheArmIntoItselfIsRefusedBeforeAnythingMoves) {
  api::ApiClient mission = join("mission");
  enable(mission);
  const Json start = move_request(0.0)["goal_deg"];
  const Json curled{18, 0, 18, 0, 18, 0, 18, 0, 18, 0};
  ASSERT_EQ(ask(mission, {{"op", "move_path"}, {"points_deg", {start, curled}}}), "ok");
  state(mission);
  const Json refused = state(mission);
  EXPECT_EQ(refused["refusals"], 1);
  EXPECT_EQ(refused["verdict"]["code"], 207);
  EXPECT_TRUE(names(refused["verdict"]["text"].get<std::string>(), {"points 1 and 2"}));
  EXPECT_EQ(refused["path"], Json());
  EXPECT_FALSE(refused["is_busy"]);
  EXPECT_EQ(refused["setpoint_js_deg"], start);
}

TEST_F(ServiceOverSocket, ALineMayHoldVariablesAsHoldThetaWritesThem) {
  api::ApiClient mission = join("mission");
  enable(mission);
  const Json before = state(mission);
  const Json held{{{"theta", 9}, {"target_deg", before["setpoint_js_deg"][8]}}};
  EXPECT_EQ(ask(mission, {{"op", "move_cp"}, {"goal", before["setpoint_cp"]}, {"hold", {9}}}), "bad_request");
  ASSERT_EQ(ask(mission, {{"op", "move_cp"}, {"goal", before["setpoint_cp"]}, {"hold", held}}), "ok");
  intervals(10);
  EXPECT_EQ(state(mission)["held"], Json({9}));
}

TEST_F(ServiceOverSocket, TheDeathOfTheMissionIsAHold) {
  auto mission = std::make_unique<api::ApiClient>(join("mission"));
  api::ApiClient watcher = join("observer");
  enable(*mission);
  ASSERT_EQ(ask(*mission, move_request(5.0)), "ok");
  intervals(40);
  ASSERT_GT(arm_->now().tip_speed_m_s, 1e-3) << "the arm moves";
  mission.reset();
  intervals(100);
  const Json after = state(watcher);
  EXPECT_EQ(after["state"], "ENABLED") << "a hold keeps the drives enabled";
  EXPECT_TRUE(after["at_rest"]);
  EXPECT_EQ(after["owner"], "");
  const cable::ThetaVector stopped = arm_->now().theta_command_rad;
  intervals(20);
  EXPECT_EQ(arm_->now().theta_command_rad, stopped);
}

// It would be answered with ok, and lost.
TEST_F(ServiceOverSocket, AnArmThatStopsIsNotEnabledUntilItIsDisabled) {
  api::ApiClient client = join("mission");
  enable(client);
  EXPECT_EQ(ask(client, {{"op", "state_command"}, {"command", "disable"}}), "ok");
  EXPECT_EQ(ask(client, {{"op", "state_command"}, {"command", "enable"}}), "busy");
  for (int i = 0; i < 500 && arm_->now().state != OperatingState::kDisabled; ++i) intervals(1);
  enable(client);
}

TEST_F(ServiceOverSocket, OnlyOneClientMovesTheArm) {
  api::ApiClient mission = join("mission"), second = join("client"), watcher = join("observer");
  enable(mission);
  EXPECT_EQ(ask(second, {{"op", "acquire"}}), "not_owner");
  EXPECT_EQ(ask(second, move_request(0.1)), "not_owner");
  EXPECT_EQ(ask(second, {{"op", "hold"}}), "not_owner");
  EXPECT_EQ(ask(second, {{"op", "state_command"}, {"command", "disable"}}), "not_owner");
  EXPECT_EQ(ask(watcher, {{"op", "acquire"}}), "not_owner");
  ASSERT_EQ(ask(mission, {{"op", "release"}}), "ok");
  EXPECT_EQ(ask(second, {{"op", "acquire"}}), "ok");
}

// The owner is a client that reads nothing and sends nothing.
TEST_F(ServiceOverSocket, AnOwnerThatStandsStillLosesMotionByNameAndTheArmHolds) {
  api::ApiClient stuck = join("client"), second = join("client", {"event"});
  enable(stuck);
  ASSERT_EQ(ask(stuck, move_request(5.0)), "ok");
  intervals(40);
  ASSERT_GT(arm_->now().tip_speed_m_s, 1e-3) << "the arm moves";
  EXPECT_EQ(ask(second, {{"op", "acquire"}, {"from", "client"}}), "not_owner") << "the owner was heard just now";
  const auto begin = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begin < std::chrono::duration<double>(kMaxSilence_s)) {
    service_.idle(0.05);
    while (second.receive(0.0)) {
    }
  }
  EXPECT_EQ(ask(second, {{"op", "acquire"}}), "not_owner") << "not without its name";
  EXPECT_EQ(ask(second, {{"op", "acquire"}, {"from", "another"}}), "not_owner");
  ASSERT_EQ(ask(second, {{"op", "acquire"}, {"from", "client"}}), "ok");
  intervals(100);
  EXPECT_EQ(arm_->now().state, OperatingState::kEnabled) << "a hold keeps the drives enabled";
  EXPECT_LT(arm_->now().tip_speed_m_s, 1e-9);
  EXPECT_EQ(ask(stuck, {{"op", "hold"}}), "not_owner");
}

TEST_F(ServiceOverSocket, AfterAStopAClientTakesMotionByNameAndEnables) {
  api::ApiClient mission = join("mission"), second = join("client", Json::array());
  enable(mission);
  ASSERT_EQ(ask(second, {{"op", "stop"}}), "ok");
  for (int i = 0; i < 500 && arm_->now().state != OperatingState::kDisabled; ++i) intervals(1);
  EXPECT_EQ(ask(second, {{"op", "acquire"}}), "not_owner") << "the owner is alive";
  api::ApiClient watcher = join("observer", {"event"});
  ASSERT_EQ(ask(second, {{"op", "acquire"}, {"from", "mission"}}), "ok");
  EXPECT_EQ(ask(second, {{"op", "state_command"}, {"command", "enable"}}), "ok");
  std::vector<std::string> told;
  while (const auto message = watcher.receive(0.0)) {
    if (message->value("kind", "") == "owner")
      told.push_back(std::to_string(message->value("number", 0)) + " " + message->value("subject", ""));
  }
  EXPECT_EQ(told, (std::vector<std::string>{"5 mission", "1 client"}));
  EXPECT_EQ(ask(mission, {{"op", "acquire"}, {"from", "client"}}), "not_owner") << "a mission takes from nobody";
}

TEST_F(ServiceOverSocket, AnyoneMayStop) {
  api::ApiClient mission = join("mission"), watcher = join("observer");
  enable(mission);
  ask(mission, move_request(5.0));
  intervals(30);
  ASSERT_EQ(ask(watcher, {{"op", "stop"}, {"reason", "test"}}), "ok");
  for (int i = 0; i < 500 && arm_->now().state != OperatingState::kDisabled; ++i) intervals(1);
  EXPECT_EQ(state(watcher)["state"], "DISABLED");
}

TEST_F(ServiceOverSocket, AStopIsTakenWhateverItsReasonOrItsSpelling) {
  api::ApiClient watcher = join("observer"), other = join("client");
  intervals(2);
  const std::string filler(60000, 'x'), deep(5000, '[');
  const std::vector<std::pair<std::string, std::string>> table{
      {R"({"op":"stop","id":1})", ""},
      {R"({"op":"stop","id":1,"reason":""})", ""},
      {R"({"op":"stop","id":1,"reason":null})", ""},
      {R"({"op":"stop","id":1,"reason":7})", "7"},
      {R"({"op":"stop","id":1,"reason":["a",{"b":1}]})", R"(["a",{"b":1}])"},
      {R"({"op":"stop","id":1,"reason":"a\u0007b"})", "a b"},
      {R"({"op":"stop","id":1,"reason":")" + filler + "\"}", filler.substr(0, 200)},
      {R"({"op":"stop","id":"one","reason":"a"})", "a"},
      {R"({"op":"stop","id":1,"reason":")" + filler + filler + "\"}", filler.substr(0, 200)},
      {R"({"reason":")" + filler + filler + R"(","op":"stop"})", filler.substr(0, 200)},
      {R"({"op":"stop","reason":)" + deep, deep.substr(0, 200)},
      {"{\"op\":\"stop\",\"reason\":\"\xff\"}", "?"},
      {R"({"op":"stop","reason":"cut sho)", "cut sho"},
  };
  for (const auto& [packet, reason] : table) {
    SCOPED_TRACE(packet.substr(0, 60));
    ASSERT_EQ(api::send_packet(watcher.fd(), packet), api::SocketResult::kDone);
    service_.idle(0.01);
    EXPECT_TRUE(arm_->link.stop.take());
    while (const auto heard = watcher.receive(0.0)) {
      EXPECT_NE(heard->value("op", ""), "error") << *heard;
    }
    const Json stop = state(watcher)["stop"];
    ASSERT_TRUE(stop.is_object());
    EXPECT_EQ(stop["reason"], reason);
    EXPECT_EQ(ask(other, {{"op", "acquire"}}), "ok") << "releases the stop";
    EXPECT_TRUE(state(watcher)["stop"].is_null());
  }
}

TEST_F(ServiceOverSocket, AStopActsInTheNextTickThoughNoOtherRequestHasRoom) {
  api::ApiClient mission = join("mission"), watcher = join("observer");
  enable(mission);
  for (int i = 0; i < 40; ++i) ask(mission, {{"op", "state_command"}, {"command", "clear"}});
  ASSERT_EQ(ask(mission, {{"op", "state_command"}, {"command", "clear"}}), "busy");
  ASSERT_EQ(ask(watcher, {{"op", "stop"}}), "ok");
  arm_->tick();
  EXPECT_EQ(arm_->now().state, OperatingState::kStopping);
}

TEST_F(ServiceOverSocket, AStopIsServedBeforeWhatOthersAskedForEarlier) {
  api::ApiClient mission = join("mission"), watcher = join("observer");
  enable(mission);
  for (int i = 0; i < 100; ++i) mission.send({{"op", "tool"}, {"command", std::to_string(i)}});
  mission.send(move_request(5.0));
  watcher.send({{"op", "stop"}, {"reason", "now"}});
  intervals(1);
  EXPECT_EQ(arm_->now().state, OperatingState::kStopping);
  for (int i = 0; i < 600 && arm_->now().state != OperatingState::kDisabled; ++i) intervals(1);
  const Json after = state(watcher);
  EXPECT_EQ(after["state"], "DISABLED");
  EXPECT_EQ(after["stop"], Json({{"by", "observer"}, {"reason", "now"}, {"tick", after["stop"]["tick"]}}));
  EXPECT_FALSE(after["is_busy"]);
}

TEST_F(ServiceOverSocket, WhatAMissionAskedForBesideItsOwnStopDoesNotEnableTheArm) {
  api::ApiClient mission = join("mission");
  ASSERT_EQ(ask(mission, {{"op", "acquire"}}), "ok");
  intervals(10);
  mission.send({{"op", "state_command"}, {"command", "enable"}, {"id", 900}});
  mission.send({{"op", "stop"}, {"reason", "the end"}});
  intervals(200);
  EXPECT_EQ(arm_->now().state, OperatingState::kDisabled);
  EXPECT_TRUE(state(mission)["stop"].is_null()) << "a mission's stop is how it ends";
}

TEST_F(ServiceOverSocket, AStopOfLianadItselfIsToldToEverybody) {
  api::ApiClient watcher = join("observer");
  intervals(2);
  service_.stop_by_itself("the real-time thread failed");
  const auto last = watcher.receive(1.0);
  ASSERT_TRUE(last);
  Json told = *last;
  while (const auto next = watcher.receive(0.0)) told = *next;
  EXPECT_EQ(told["stop"]["by"], "lianad");
  EXPECT_EQ(told["stop"]["reason"], "the real-time thread failed");
  EXPECT_TRUE(arm_->link.stop.is_pressed());
}

TEST_F(ServiceOverSocket, AShutdownStopsTheArmThoughTheQueueOfRequestsIsFull) {
  api::ApiClient mission = join("mission");
  enable(mission);
  while (arm_->link.requests.push(Request::kClear)) {
  }
  EXPECT_NO_THROW(service_.begin_shutdown("signal"));
  arm_->tick();
  EXPECT_EQ(arm_->now().state, OperatingState::kStopping);
}

TEST_F(ServiceOverSocket, BadMotionRequestsAreRefusedWithTheirReason) {
  api::ApiClient mission = join("mission");
  ask(mission, {{"op", "acquire"}});
  intervals(2);
  EXPECT_EQ(ask(mission, move_request(0.1)), "not_enabled");
  enable(mission);
  const Json unit{1, 0, 0, 0};
  const auto pose = [](double x, double qw) { return Json{x, 0, 0, qw, 0, 0, 0}; };
  const std::vector<std::pair<Json, std::string>> table{
      {{{"op", "dance"}}, "bad_request"},
      {{{"op", "move_jp"}}, "bad_request"},
      {{{"op", "move_jp"}, {"goal_deg", {1, 2, 3}}}, "bad_request"},
      {{{"op", "move_jp"}, {"goal_deg", {25, 0, 0, 0, 0, 0, 0, 0, 0, 0}}}, "out_of_range"},
      {{{"op", "move_jp"}, {"goal_deg", {nullptr, 0, 0, 0, 0, 0, 0, 0, 0, 0}}}, "bad_request"},
      {{{"op", "move_jp"}, {"goal_deg", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}, {"rate_deg_s", 50}}, "out_of_range"},
      {{{"op", "move_path"}, {"points_deg", {{1, 2, 3}}}}, "bad_request"},
      {{{"op", "move_path"}, {"points_deg", Json::array()}}, "out_of_range"},
      {{{"op", "move_path"}, {"points_deg", {{25, 0, 0, 0, 0, 0, 0, 0, 0, 0}}}}, "out_of_range"},
      {{{"op", "move_path"}, {"points_deg", {{0, 20, 0, 0, 0, 0, 0, 0, 0, 0}}}}, "refused"},
      {{{"op", "move_cp"}, {"goal", pose(1e30, 1)}}, "out_of_range"},
      {{{"op", "move_cp"}, {"goal", pose(4.5, 1)}}, "out_of_range"},
      {{{"op", "move_cp"}, {"goal", pose(1, 0.5)}}, "out_of_range"},
      {{{"op", "servo_cp"}, {"goal", "there"}}, "bad_request"},
      {{{"op", "hold_theta"}, {"held", {{{"theta", 11}, {"target_deg", 0}}}}}, "out_of_range"},
      {{{"op", "hold_theta"}, {"held", {{{"theta", 9}, {"target_deg", 30}}}}}, "out_of_range"},
      {{{"op", "hold_theta"}, {"held", 9}}, "bad_request"},
      {{{"op", "hold_theta"}, {"held", {9}}}, "bad_request"},
      {{{"op", "shape"}, {"nodes", {{{"node", 9}, {"position_m", {0, 0, 0}}}}}}, "out_of_range"},
      {{{"op", "use_device"}, {"device", "mouse"}}, "no_device"},
      {{{"op", "use_device"}, {"device", "vr"}}, "no_device"},
      {{{"op", "use_device"}, {"device", "none"}, {"scale", -1}}, "out_of_range"},
      {{{"op", "use_device"}, {"device", "none"}, {"fixtures", {"nowhere"}}}, "out_of_range"},
      {{{"op", "use_device"}, {"device", "none"}, {"feedback", "loud"}}, "bad_request"},
      {{{"op", "state_command"}, {"command", "fly"}}, "bad_request"},
      {{{"op", "camera"}, {"capture_time_s", 0}}, "bad_request"},
      {{{"op", 7}}, "bad_request"},
      {{{"op", "hold"}, {"now", true}}, "bad_request"},
      {{{"op", "move_jp"}, {"goal_deg", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}}, {"rate", 1}}, "bad_request"},
  };
  for (const auto& [request, code] : table) EXPECT_EQ(ask(mission, request), code) << request.dump();
  intervals(20);
  EXPECT_TRUE(arm_->now().at_rest);
  EXPECT_EQ(arm_->now().faults.count, 0);
}

TEST_F(ServiceOverSocket, EveryOperationOfTheTableIsServed) {
  std::map<std::string, api::ApiClient> clients;
  for (const char* role : api::kRoleNames) clients.emplace(role, join(role));
  for (const api::RequestRow& row : api::request_table()) {
    if (row.op == std::string("hello") || row.op == std::string("done")) continue;  // the server's own
    const std::string role = row.owner_only ? "client" : api::roles_text(row.roles);
    api::ApiClient& client = clients.at(role.substr(0, role.find(',')));
    ASSERT_EQ(ask(clients.at("client"), {{"op", "acquire"}}), "ok");
    const Json answer = full_answer(client, {{"op", row.op}});
    EXPECT_EQ(answer.value("message", "").find("not served"), std::string::npos) << row.op << answer;
    EXPECT_EQ(answer.value("message", "").find("unknown"), std::string::npos) << row.op << answer;
    ask(clients.at("client"), {{"op", "release"}});
    ask(clients.at("mission"), {{"op", "release"}});
  }
}

TEST_F(ServiceOverSocket, AnOwnerThatStandsStillInAStreamIsNamedAndTheArmHoldsWithinTheTimeToLive) {
  api::ApiClient mission = join("mission");
  enable(mission);
  Json goal = state(mission)["setpoint_cp"];
  goal[2] = goal[2].get<double>() + 0.04;
  const auto servo = [&](int sequence) -> Json {
    return {{"op", "servo_cp"}, {"goal", goal}, {"ttl_s", 0.1}, {"sequence", sequence}};
  };
  for (int i = 1; i <= 20; ++i) {
    ASSERT_EQ(ask(mission, servo(i)), "ok");
    intervals(1);
  }
  ASSERT_EQ(arm_->now().at_rest, 0);
  const std::uint64_t last_tick = arm_->ticks_done();
  intervals(5);
  const Json events = state(mission)["events"];
  ASSERT_TRUE(names(events.back()["text"].text(), {"mission", "servo_cp", "0.1 s", "ttl_s"}));
  EXPECT_LE((events.back()["tick"].get<double>() - static_cast<double>(last_tick)) * arm_->table().tick_s, 0.1);
  EXPECT_EQ(ask(mission, servo(20)), "refused") << "a repeated number";
  intervals(100);
  EXPECT_TRUE(arm_->now().at_rest);
  EXPECT_GT(norm(subtract(Vec3{goal[0], goal[1], goal[2]}, arm_->now().tip_command.position_m)), 1e-3);
}

TEST_F(ServiceOverSocket, AGoalOfAStreamThatJumpsIsRefusedAndAMoveIsNot) {
  api::ApiClient mission = join("mission");
  enable(mission);
  Json goal = state(mission)["setpoint_cp"];
  goal[2] = goal[2].get<double>() + 0.06;
  const Json refused = full_answer(mission, {{"op", "servo_cp"}, {"goal", goal}});
  EXPECT_EQ(refused["code"], "out_of_range");
  EXPECT_TRUE(names(refused["message"].get<std::string>(), {"servo_cp", "0", "0.05 m", "move_cp"})) << refused;
  EXPECT_EQ(ask(mission, {{"op", "move_cp"}, {"goal", goal}}), "ok");
}

// req:A13 req:A28
TEST_F(ServiceOverSocket, TheOperatorSteersAndLettingGoIsAHold) {
  api::ApiClient mission = join("mission");
  device::Driver hand = plug_in({.name = "omega"});
  enable(mission);
  ASSERT_EQ(ask(mission, {{"op", "use_device"}, {"device", "hand"}, {"scale", 1.0}, {"speed_m_s", 0.03}}), "ok");
  const Vec3 start = arm_->now().tip_command.position_m;
  std::int64_t t_us = 0;
  const auto steer = [&](double x, bool deadman) {
    for (int i = 0; i < 20; ++i) hand.send({.t_us = t_us += 1000, .deadman = deadman, .pose = {{x, 0.0, 0.0}}});
    hand.receive(t_us);
    return state(mission);
  };
  for (int i = 0; i <= 100; ++i) steer(1e-4 * i, true);
  const Json moving = steer(0.01, true);
  EXPECT_TRUE(moving["device_engaged"]);
  EXPECT_EQ(moving["devices"][0]["name"], "omega");
  EXPECT_TRUE(moving["devices"][0]["in_use"]);
  EXPECT_EQ(moving["mapping"]["scale"], 1.0);
  const Json& source_stamp = moving["verdict"]["source_stamp"];
  EXPECT_EQ(source_stamp["newest_us"].get<std::int64_t>() - source_stamp["oldest_us"].get<std::int64_t>(), 19000);
  EXPECT_NEAR(source_stamp["in_force_s"].get<double>() - source_stamp["released_s"].get<double>(), 0.02, 1e-9);
  EXPECT_GT(norm(subtract(arm_->now().tip_command.position_m, start)), 2e-3);
  for (int i = 0; i < 100; ++i) steer(0.01, false);
  EXPECT_FALSE(steer(0.01, false)["device_engaged"]);
  EXPECT_TRUE(arm_->now().at_rest);
  EXPECT_EQ(steer(0.01, false)["refusals"], 0);
}

// In virtual time a sample that comes with its interval is of the command that is in force in the next one.
TEST_F(ServiceOverSocket, ADeviceIsToldEveryIntervalWhereTheTipIsAndWhatItsSamplesLedTo) {
  api::ApiClient mission = join("mission");
  device::Driver hand = plug_in({.name = "omega"}), other = plug_in({.name = "falcon"});
  enable(mission);
  ASSERT_EQ(ask(mission, {{"op", "use_device"}, {"device", "omega"}, {"scale", 0.5}}), "ok");
  std::int64_t t_us = 0;
  for (int i = 0; i < 50; ++i) {
    hand.send({.t_us = t_us += 20000, .deadman = true, .pose = {{1e-4 * i, 0.0, 0.0}}});
    state(mission);
    hand.receive(t_us);
    other.receive(t_us);
  }
  const liana_state* told = hand.state(t_us);
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->flags, static_cast<std::uint32_t>(LIANA_ENABLED | LIANA_IN_USE | LIANA_ENGAGED));
  EXPECT_EQ(told->answers_us, t_us - 20000) << "the newest was not yet heard, the one before is in force since now";
  EXPECT_EQ(told->held_us, 0);
  EXPECT_EQ(told->scale, 0.5);
  EXPECT_EQ(told->planes, 6u) << "the ends of its workspace";
  const Vec3 setpoint_m = device::pose_of(told->setpoint_cp).position_m;
  EXPECT_LT(norm(subtract(setpoint_m, arm_->now().tip_command.position_m)), 0.001) << "one interval ago";
  EXPECT_LT(norm(subtract(setpoint_m, device::pose_of(told->measured_cp).position_m)), 0.02);
  EXPECT_NE(told->present & LIANA_HAS_PREDICTED, 0u);
  EXPECT_LT(norm(subtract(device::pose_of(told->predicted_cp).position_m, setpoint_m)), 0.005);
  const liana_state* to_other = other.state(t_us);
  ASSERT_NE(to_other, nullptr);
  EXPECT_EQ(to_other->flags, static_cast<std::uint32_t>(LIANA_ENABLED));
  EXPECT_EQ(to_other->answers_us, -1) << "its samples move nothing";
}

// req:A12
TEST_F(ServiceOverSocket, ADeviceThatIsGoneIsAHoldAndAnotherTakesItsPlaceOnlyAfterLettingGo) {
  api::ApiClient mission = join("mission");
  enable(mission);
  std::int64_t t_us = 0;
  const auto steer = [&](device::Driver& hand, bool deadman, int intervals = 1) {
    Json last;
    for (int i = 0; i < intervals; ++i) {
      hand.send({.t_us = t_us += 20000, .deadman = deadman, .pose = {{0.1, 0.0, 0.0}}});
      last = state(mission);
    }
    return last;
  };
  {
    device::Driver hand = plug_in({.name = "omega"});
    ASSERT_EQ(ask(mission, {{"op", "use_device"}, {"device", "hand"}}), "ok");
    EXPECT_TRUE(steer(hand, true, 3)["device_engaged"]);
  }
  state(mission);
  const Json alone = state(mission);
  EXPECT_FALSE(alone["device_engaged"]);
  EXPECT_EQ(alone["device_reason"], "device gone");
  EXPECT_EQ(alone["device"], "hand");
  EXPECT_EQ(alone["devices"], Json::array());
  device::Driver again = plug_in({.name = "omega"});
  t_us = 0;  // with a clock of its own
  EXPECT_FALSE(steer(again, true, 5)["device_engaged"]);
  steer(again, false, 2);
  EXPECT_TRUE(steer(again, true, 3)["device_engaged"]);
}

TEST_F(ServiceOverSocket, ADeviceIsChosenByKindOrNameAndWhatIsConnectedIsSaidOtherwise) {
  api::ApiClient mission = join("mission");
  enable(mission);
  device::Driver first = plug_in({.name = "omega"});
  const auto message = [&](const char* name) {
    return full_answer(mission, {{"op", "use_device"}, {"device", name}}).value("message", "");
  };
  EXPECT_TRUE(names(message("vr"), {"device", "vr", "omega", "hand"}));
  EXPECT_EQ(ask(mission, {{"op", "use_device"}, {"device", "hand"}}), "ok");
  EXPECT_EQ(ask(mission, {{"op", "use_device"}, {"device", "omega"}}), "ok");
  device::Driver second = plug_in({.name = "falcon"}), puck = plug_in({.name = "puck", .kind = device::Kind::kPointer});
  EXPECT_TRUE(names(message("hand"), {"device", "hand", "falcon", "omega"}));
  EXPECT_EQ(ask(mission, {{"op", "use_device"}, {"device", "pointer"}}), "ok");
  EXPECT_EQ(ask(mission, {{"op", "use_device"}, {"device", "falcon"}}), "ok");
  EXPECT_EQ(ask(mission, {{"op", "use_device"}, {"device", "none"}}), "ok");
}

TEST_F(ServiceOverSocket, WhatDevicesCanAndDoIsAskedForByAnybody) {
  api::ApiClient observer = join("observer");
  device::Capability capability{.name = "omega"};
  capability.hand[0].max_force_N = 12.0;
  device::Driver hand = plug_in(capability);
  hand.send({.t_us = 7, .deadman = true, .pose = {{0.25, 0.0, 0.0}}});
  const Json told = full_answer(observer, {{"op", "devices"}})["devices"][0];
  EXPECT_EQ(told["kind"], "hand");
  EXPECT_EQ(told["hands"][0]["max_force_N"], 12.0);
  EXPECT_EQ(told["hands"][0]["sample"]["measured_cp"][0], 0.25);
  EXPECT_EQ(told["rate_hz"], Json()) << "a second is not over";
}

// req:A24
TEST_F(ServiceOverSocket, ADeviceUnderFiftyHertzIsAnAlarmUntilItIsFastAgainAndItsIntervalsAreLogged) {
  api::ApiClient mission = join("mission");
  device::Driver hand = plug_in({.name = "omega"});
  enable(mission);
  std::int64_t t_us = 0;
  const auto sample_for = [&](int intervals, int step_us) {
    Json last;
    for (const std::int64_t end_us = t_us + 20000LL * intervals; t_us < end_us; last = state(mission)) {
      for (const std::int64_t until_us = t_us + 20000; t_us < until_us; t_us += step_us) hand.send({.t_us = t_us});
      hand.receive(t_us);
    }
    return last;
  };
  ASSERT_EQ(ask(mission, {{"op", "use_device"}, {"device", "hand"}}), "ok");
  EXPECT_EQ(state(mission)["device_rate"], Json());
  const Json fast = sample_for(150, 10000)["device_rate"];
  EXPECT_NEAR(fast["hz"].get<double>(), 100.0, 0.1);
  EXPECT_NEAR(fast["min_s"].get<double>(), 0.01, 1e-9);
  sample_for(300, 25000);
  ASSERT_EQ(ask(mission, {{"op", "use_device"}, {"device", "none"}}), "ok");
  const std::string events = state(mission)["events"].dump();
  EXPECT_TRUE(names(events, {"device hand", "samples a second", "50"}));
  EXPECT_TRUE(names(events, {"device hand is left", "10.0 to 25.0 ms"}));
}

TEST_F(ServiceOverSocket, WhatMissionAndOperatorTellEachOtherIsRepeated) {
  api::ApiClient mission = join("mission"), person = join("operator");
  EXPECT_EQ(ask(mission, {{"op", "announce"}, {"step", {{"index", 2}, {"name", "around"}, {"device", "vr"}}}}), "ok");
  EXPECT_EQ(ask(person, {{"op", "operator_says"}, {"what", "arrived"}}), "ok");
  EXPECT_EQ(ask(person, {{"op", "announce"}, {"step", nullptr}}), "bad_request");
  const Json heard = state(mission);
  EXPECT_EQ(heard["step"]["name"], "around");
  EXPECT_EQ(heard["operator_says"]["what"], "arrived");
  const Json again{{"index", 2}, {"name", "around"}, {"device", "vr"}, {"task", "my_hand"}, {"entry", 3}};
  EXPECT_EQ(ask(mission, {{"op", "announce"}, {"step", again}, {"after", "arm at rest"}}), "ok");
  const Json told = state(mission);
  EXPECT_EQ(told["step"]["task"], "my_hand");
  EXPECT_EQ(told["step"]["entry"], 3);
  EXPECT_TRUE(names(told["events"].back()["text"].text(), {"step 2", "around", "arm at rest"}));
  EXPECT_EQ(ask(mission, {{"op", "announce"}, {"step", nullptr}, {"after", "device released"}}), "ok");
  EXPECT_TRUE(state(mission)["step"].is_null());
}

TEST_F(ServiceOverSocket, WhatPeopleAskOfAMissionIsRepeatedUntilAnotherMissionComes) {
  api::ApiClient person = join("client");
  const Json abort{{"op", "mission_control"}, {"command", "abort"}};
  const Json none = full_answer(person, abort);
  EXPECT_EQ(none["code"], "refused");
  EXPECT_TRUE(state(person)["mission_control"].is_null());
  {
    api::ApiClient mission = join("mission");
    EXPECT_EQ(ask(person, abort), "ok");
    EXPECT_EQ(state(mission)["mission_control"]["command"], "abort") << "asked for before its first state";
  }
  state(person);
  api::ApiClient next = join("mission");
  EXPECT_TRUE(state(next)["mission_control"].is_null());
}

TEST_F(ServiceOverSocket, AFullDiskOfTheFlightRecorderIsAnEventAndNobodyElseCanSayIt) {
  api::ApiClient archive = join("archive"), person = join("client");
  const Json alarm{{"op", "archive_alarm"}, {"text", "ticks 5 to 9 missing"}, {"count", 5}};
  EXPECT_EQ(ask(archive, alarm), "ok");
  EXPECT_NE(ask(person, alarm), "ok");
  const Json events = state(person)["events"];
  ASSERT_FALSE(events.empty());
  const auto is_said = [](const Json& event) {
    return static_cast<bool>(names(event.at("text").text(), {"archive", "ticks 5 to 9 missing"}));
  };
  EXPECT_EQ(std::count_if(events.begin(), events.end(), is_said), 1);
}

// req:A7
TEST_F(ServiceOverSocket, ACameraFrameIsForwardedWhenEveryRunHasReceivedIt) {
  api::ApiClient camera = join("camera", Json::array()), person = join("operator", {"camera"});
  camera.send({{"op", "camera"}, {"capture_time_s", 0.0}, {"slit", nullptr}, {"rod", nullptr}});
  // Ready at 0.1 s = tick 25, certain three ticks later: forwarded at the start of the interval at tick 30.
  intervals(6);
  EXPECT_FALSE(person.receive(0.0));
  intervals(1);
  EXPECT_EQ(person.receive(0.0).value_or(Json()).value("op", ""), "camera");
}

TEST_F(ServiceOverSocket, ShutdownEndsWhenTheDrivesAreOff) {
  api::ApiClient mission = join("mission"), person = join("client");
  enable(mission);
  EXPECT_FALSE(service_.finished());
  ASSERT_EQ(ask(person, {{"op", "shutdown"}}), "ok");
  int count = 0;
  while (!service_.finished() && ++count < 600) intervals(1);
  EXPECT_TRUE(service_.finished());
  EXPECT_EQ(arm_->now().state, OperatingState::kDisabled);
}

TEST_F(ServiceOverSocket, TimingIsRefusedInVirtualTime) {
  api::ApiClient watcher = join("observer");
  const Json answer = full_answer(watcher, {{"op", "timing"}});
  EXPECT_EQ(answer["code"], "refused");
  EXPECT_NE(answer["message"].get<std::string>().find("--time real"), std::string::npos) << answer;
}

class ServiceInRealTime : public ServiceOverSocket {
 protected:
  ServiceInRealTime() : ServiceOverSocket(timing::TimeMode::kReal) {}
};

TEST_F(ServiceInRealTime, TimingTellsWhatTheRealTimeThreadRecordedSinceTheLastReset) {
  api::ApiClient watcher = join("observer");
  realtime::TickTiming& timing = arm_->link.timing;
  realtime::ArmTickStatus<cable::CableArm> report = arm_->link.report.value();
  const auto record = [&](std::uint32_t late_us, std::uint32_t tick_us, std::uint64_t overruns) {
    timing.wakeup_us.record(late_us);
    timing.tick_us.record(tick_us);
    report.overruns = {overruns, 0, 0, overruns};
    arm_->link.report.publish(report);
  };
  record(12, 150, 0);
  record(5000, 170, 2);
  const Json first = full_answer(watcher, {{"op", "timing"}, {"reset", true}});
  EXPECT_EQ(first["ticks"], 2);
  EXPECT_EQ(first["wakeup_us"], Json::parse(R"({"median":12,"p99":5000,"worst":5000,"buckets":[[12,1],[2048,1]]})"));
  EXPECT_EQ(first["overruns"], 2);
  record(9, 160, 3);
  for (int i = 0; i < 2; ++i) {  // reading alone changes nothing
    const Json second = full_answer(watcher, {{"op", "timing"}});
    EXPECT_EQ(second["ticks"], 1);
    EXPECT_EQ(second["wakeup_us"]["worst"], 9);
    EXPECT_EQ(second["tick_us"]["median"], 160);
    EXPECT_EQ(second["overruns"], 1);
    EXPECT_EQ(second["overrun_causes"]["lost_ticks"], 1);
  }
  EXPECT_EQ(full_answer(watcher, {{"op", "timing"}, {"reset", "yes"}})["code"], "bad_request");
}

TEST_F(ServiceOverSocket, WaitingForClientsEndsWhenItIsToldTo) {
  int looks = 0;
  EXPECT_FALSE(service_.wait_for({api::Role::kOperator}, 600.0, [&] { return ++looks == 2; }));
  EXPECT_EQ(looks, 2);
}

TEST_F(ServiceOverSocket, MissingClientsAreNamed) {
  try {
    service_.wait_for({api::Role::kOperator}, 0.05);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("operator"), std::string::npos);
  }
}

}  // namespace
}  // namespace liana::server
