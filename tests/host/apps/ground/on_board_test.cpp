// The on-board end by what goes in and out: telecommands, requests, states, reports.
#include "host/apps/ground/on_board.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace liana::ground {
namespace {

// An end whose lianad is this test.
class Bench {
 public:
  explicit Bench(double silence_s = 10.0)
      : on_board({silence_s, 1000000}, {[this](const std::string& packet) { packets.push_back(packet); },
                                        [this](const Json& request) {
                                          requests.push_back(request);
                                          return true;
                                        },
                                        [this] { ++left; }}) {
    on_board.set_time(0.0, 1000000);
  }

  void send(std::uint8_t service, std::uint8_t subtype, std::string data = "", std::uint8_t acknowledge = 15,
            std::uint16_t source = 0) {
    Telecommand out;
    out.source = source;
    out.primary = {0, true, true, kArmApid, 3, count++, 1};
    out.acknowledge = acknowledge;
    out.service = service;
    out.subtype = subtype;
    out.data = std::move(data);
    on_board.receive(telecommand_bytes(out));
  }
  // Subtypes of the reports of service 1 since the last call.
  std::vector<int> verified() {
    std::vector<int> out;
    for (; seen < packets.size(); ++seen) {
      const auto report = read_telemetry(packets[seen]);
      if (report && report->service == 1) out.push_back(report->subtype);
    }
    return out;
  }
  std::uint64_t last_code() const {
    const Json report = report_json(*read_telemetry(packets.back()), Sizes());
    return report.at("values").value("code", std::uint64_t{0});
  }

  std::vector<std::string> packets;
  std::vector<Json> requests;
  int left = 0;
  std::uint16_t count = 0;
  std::size_t seen = 0;
  OnBoard on_board;
};

std::string function(std::uint16_t id, const std::string& arguments = "") {
  std::string out;
  append_whole(out, id, 2);
  return out + arguments;
}

TEST(OnBoard, ReportsTheSuccessesThatAreAskedFor) {
  for (unsigned flags = 0; flags < 16; ++flags) {
    Bench bench;
    bench.send(17, 1, "", static_cast<std::uint8_t>(flags));
    std::vector<int> wanted;
    if ((flags & 1u) != 0) wanted.push_back(1);
    if ((flags & 2u) != 0) wanted.push_back(3);
    if ((flags & 8u) != 0) wanted.push_back(7);
    EXPECT_EQ(bench.verified(), wanted) << flags;
  }
}

TEST(OnBoard, ReportsFailuresAlsoWhereNothingIsAskedFor) {
  Bench bench;
  bench.send(17, 1, "x", 0);
  EXPECT_EQ(bench.verified(), std::vector<int>{2});
  EXPECT_EQ(bench.last_code(), 27u);
}

TEST(OnBoard, RefusesFunctionsWhileLianadIsNotThere) {
  Bench bench;
  bench.send(8, 1, function(2));
  EXPECT_EQ(bench.verified(), std::vector<int>{2});
  EXPECT_EQ(bench.last_code(), 29u);
  EXPECT_TRUE(bench.requests.empty());
}

TEST(OnBoard, SendsItsOwnCountersWithoutLianadAndNothingElse) {
  Bench bench;
  for (const char structure : {'\1', '\2', '\3', '\4'}) {
    bench.send(3, 27, std::string{'\1', structure});
    EXPECT_EQ(bench.verified(), std::vector<int>{2}) << static_cast<int>(structure);
    EXPECT_EQ(bench.last_code(), 29u) << static_cast<int>(structure);
  }
  bench.send(3, 27, "\x01\x05", 0);
  const Json report = report_json(*read_telemetry(bench.packets.back()), Sizes());
  EXPECT_EQ(report.at("values").value("received", std::uint64_t{0}), 5u);
  EXPECT_EQ(report.at("values").value("rejected", std::uint64_t{0}), 4u);
}

TEST(OnBoard, CountsTelecommandsOutOfSequenceAndTakesThemAllTheSame) {
  Bench bench;
  for (const unsigned next : {0u, 1u, 5u, 6u, 6u, 16383u, 0u}) {
    bench.count = static_cast<std::uint16_t>(next);
    bench.send(17, 1);
  }
  EXPECT_EQ(bench.verified().size(), 21u);
}

TEST(OnBoard, CountsTheSequenceOfEachSourceForItself) {
  Bench bench;
  bench.on_board.take({{"op", "state"}});
  for (unsigned i = 0; i < 4; ++i) {
    bench.count = static_cast<std::uint16_t>(i);
    bench.send(17, 1, "", 15, 1);
    bench.count = static_cast<std::uint16_t>(16382 + i) % kCountModulus;
    bench.send(17, 1, "", 15, 2);
  }
  bench.count = 9;
  bench.send(17, 1, "", 15, 1);
  bench.send(3, 27, "\x01\x05", 0, 1);
  const Json report = report_json(*read_telemetry(bench.packets.back()), Sizes());
  EXPECT_EQ(report.at("values").value("count_jumps", std::uint64_t{0}), 1u);
}

TEST(OnBoard, SurvivesEveryLengthOfEveryTelecommand) {
  Bench bench;
  for (const CommandRow& row : commands()) {
    for (std::size_t size = 0; size < 80; ++size) {
      std::string data = row.function == 0 ? "" : function(row.function);
      data.resize(data.size() + size, '\x01');
      bench.send(row.service, row.subtype, data);
    }
  }
  EXPECT_EQ(bench.packets.empty(), false);
}

TEST(Judge, EndsAMotionAtItsGoalAndNotBefore) {
  Execution execution;
  execution.row = find_command(8, 1, 7);
  execution.request = {{"goal_deg", {1.0, 2.0}}};
  execution.is_answered = true;
  Json state{{"state", "ENABLED"},
             {"owner", "ground"},
             {"is_busy", true},
             {"at_rest", false},
             {"refused_motions", 0},
             {"stop", nullptr},
             {"setpoint_js_deg", {1.0, 2.0}}};
  execution.states = 2;
  EXPECT_FALSE(judge(execution, state));
  state["is_busy"] = false;
  state["at_rest"] = true;
  ASSERT_TRUE(judge(execution, state));
  EXPECT_EQ(judge(execution, state)->code, 0);
  state["setpoint_js_deg"] = {1.0, 2.1};
  EXPECT_EQ(judge(execution, state)->code, 31);
  execution.states = 1;
  EXPECT_FALSE(judge(execution, state));
}

TEST(Judge, TakesTheCodeFromWhatBrokeTheMotionOff) {
  Execution execution;
  execution.row = find_command(8, 1, 7);
  execution.request = {{"goal_deg", {1.0}}};
  const Json good{{"state", "ENABLED"}, {"owner", "ground"}, {"is_busy", true},
                  {"at_rest", false},   {"stop", nullptr},   {"refused_motions", 0}};
  const auto code_with = [&](const char* key, const Json& value) {
    Json state = good;
    state[key] = value;
    state["verdict"] = {{"code", 208}};
    state["faults"] = Json::array({Json{{"number", 3002}}});
    const auto ending = judge(execution, state);
    return ending ? ending->code : 0;
  };
  EXPECT_EQ(code_with("refused_motions", 1), 208);
  EXPECT_EQ(code_with("stop", Json{{"by", "x"}}), 32);
  EXPECT_EQ(code_with("state", "FAULT"), 3002);
  EXPECT_EQ(code_with("owner", "mission"), 33);
  EXPECT_EQ(code_with("is_busy", true), 0);
}

TEST(Judge, TakesNoSuccessFromARefusalOrAFaultWithoutACode) {
  Execution execution;
  execution.row = find_command(8, 1, 7);
  execution.request = {{"goal_deg", {1.0}}};
  Json state{{"state", "ENABLED"},
             {"owner", "ground"},
             {"is_busy", true},
             {"at_rest", false},
             {"refused_motions", 1},
             {"stop", nullptr},
             {"verdict", {{"code", 0}, {"sequence", 70000}}}};
  ASSERT_TRUE(judge(execution, state));
  EXPECT_EQ(judge(execution, state)->code, 31);
  state["verdict"] = {{"code", 208}, {"sequence", 70000}};
  EXPECT_EQ(judge(execution, state)->code, 208);
  EXPECT_EQ(judge(execution, state)->detail, 70000u);
  state["refused_motions"] = 0;
  state["state"] = "FAULT";
  state["faults"] = Json::array({Json{{"text", "no number"}}});
  EXPECT_EQ(judge(execution, state)->code, 31);
}

TEST(Judge, ReadsTheAnswersCode) {
  EXPECT_EQ(refused({{"code", "not_owner"}}).code, 2);
  EXPECT_EQ(refused({{"code", "no_device"}}).code, 8);
  EXPECT_EQ(refused({{"code", "something new"}}).code, 7);
}

}  // namespace
}  // namespace liana::ground
