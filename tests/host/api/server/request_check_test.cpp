// Requests against the table: what is refused, by name, and what handlers get of the others.
#include "host/api/server/request_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "host/api/server/request_error.hpp"
#include "host/api/server/request_text.hpp"
#include "tests/host/api/server/robots.hpp"
#include "tests/message.hpp"

namespace liana::api {
namespace {

const RequestBounds kZhu = request_bounds(zhu2022_json()), kMicro = request_bounds(micro_json());

// What a request is refused with, or "accepted".
struct Said {
  std::string code, text;
};

Said said_by(const std::function<void()>& check) {
  try {
    check();
  } catch (const RequestError& error) {
    return {error.code(), error.what()};
  }
  return {"accepted", ""};
}

Said said_about(const Json& request, const RequestBounds* bounds, std::size_t first = 0) {
  return said_by([&] { check_fields(row_of(request), request, bounds, first); });
}

struct Case {
  const char* request;
  const char* code;
  Facts facts;
  const char* why;
};

TEST(RequestCheck, RefusesByFieldValueAllowedRangeAndWhatToDo) {
  const std::vector<Case> cases{
      {R"({"op":"hold","id":7})", "accepted", {}, "op and id belong to every request"},
      {R"({"op":"hold","now":true})", "bad_request", {"now", "true"}, "no fields at all"},
      {R"({"op":"move_cp","gaol":1,"goal":[1,0,0,1,0,0,0]})",
       "bad_request",
       {"gaol", "1", "goal", "hold", "sway_s", "quicker_sway_s", "sway_tolerance", "sequence", "time_s", "ttl_s"},
       "a misspelt field must not pass unseen"},
      {R"({"op":"follow"})", "bad_request", {"follow", "comply"}, "an operation that had another name"},
      {R"({"op":"move_cp","swing_s":1,"goal":[1,0,0,1,0,0,0]})",
       "bad_request",
       {"swing_s", "sway_s", "now"},
       "a renamed field"},
      {R"({"op":"servo_cp"})", "bad_request", {"goal", "[x,y,z,qw,qx,qy,qz]"}, "required"},
      {R"({"op":"state_command","command":"fly"})",
       "bad_request",
       {"command", "fly", "enable", "disable", "clear", "home", "recover"},
       "a word"},
      {R"({"op":"use_device","device":"none","scale":-1})",
       "out_of_range",
       {"scale", "-1", "0.01", "100"},
       "a constant range"},
      {R"({"op":"use_device","device":"none","speed_m_s":0.5})",
       "out_of_range",
       {"speed_m_s", "0.5", "1e-04", "0.1"},
       "a range of the robot"},
      {R"({"op":"use_device","device":"none","node":1.5})", "bad_request", {"node", "1.5", "whole"}, "no integer"},
      {R"({"op":"move_jp","goal_deg":[0,0,0,0,0,0,0,0,25,0]})",
       "out_of_range",
       {"goal_deg[8]", "theta 9", "25", "-20", "20 deg"},
       "one angle of ten"},
      {R"({"op":"move_jp","goal_deg":[1,2,3]})", "bad_request", {"goal_deg", "3", "10"}, "too few"},
      {R"({"op":"move_jp","goal_deg":[null,0,0,0,0,0,0,0,0,0]})",
       "bad_request",
       {"goal_deg[0]", "null", "number"},
       "no number"},
      {R"({"op":"move_cp","goal":[3,3,0,1,0,0,0]})",
       "out_of_range",
       {"goal", "4.242641", "4"},
       "each coordinate is within"},
      {R"({"op":"move_cp","goal":[1e300,0,0,1,0,0,0]})",
       "out_of_range",
       {"goal[0]", "1e+300", "-4", "4"},
       "its square would overflow"},
      {R"({"op":"hold_theta","held":[{"theta":1,"target_deg":1},{"theta":9,"target_deg":30}]})",
       "out_of_range",
       {"entry 2", "target_deg", "30", "-20", "20"},
       "an entry"},
      {R"({"op":"hold_theta","held":[{"theta":11,"target_deg":0}]})",
       "out_of_range",
       {"entry 1", "theta", "11", "10", "1"},
       "no such angle"},
      {R"({"op":"hold_theta","held":9})", "bad_request", {"held", "9", "16"}, "no list"},
      {R"({"op":"announce","step":{"index":1,"device":"vr"}})",
       "bad_request",
       {"step", "name", "1", "120"},
       "inside an object"},
      {R"({"op":"announce","step":null})", "accepted", {}, "the end of a mission"},
      {R"({"op":"device","device":"vr","samples":[]})",
       "bad_request",
       {"op", "device", "docs/reference/api.md"},
       "devices have another socket"},
      {R"({"op":"servo_cp","goal":[1,0,0,1,0,0,0],"ttl_s":60})",
       "out_of_range",
       {"ttl_s", "60", "0.05", "10"},
       "nobody waits a minute"},
      {R"({"op":"stop","reason":7,"anything":{}})", "accepted", {}, "a stop is never refused"},
  };
  for (const Case& c : cases) {
    const Said said = said_about(Json::parse(c.request), &kZhu);
    EXPECT_EQ(said.code, c.code) << c.why;
    EXPECT_TRUE(c.facts.empty() ? said.text.empty() : static_cast<bool>(names(said.text, c.facts)))
        << c.why << ": " << said.text;
  }
}

TEST(RequestCheck, AnUnknownOpIsNamed) {
  for (const Json& op : {Json("dance"), Json(7), Json(""), Json(std::string(5000, 'x'))}) {
    const Said said = said_about({{"op", op}}, &kZhu);
    EXPECT_EQ(said.code, "bad_request");
    EXPECT_NE(said.text.find(op.dump().substr(0, 20)), std::string::npos) << said.text;
  }
}

TEST(RequestCheck, RangesAreThoseOfTheRobotThatIsServed) {
  const Json far{{"op", "move_jp"}, {"goal_deg", {0, 0, 0, 0, 0, -269, 269}}};
  EXPECT_EQ(said_about(far, &kMicro).code, "accepted");
  EXPECT_EQ(said_about(far, &kZhu).code, "bad_request");
  const Said turned = said_about({{"op", "move_jp"}, {"goal_deg", {271, 0, 0, 0, 0, 0, 0}}}, &kMicro);
  EXPECT_EQ(turned.code, "out_of_range");
  EXPECT_TRUE(names(turned.text, {"goal_deg[0]", "joint 1", "271", "-270", "270 deg"}));
  const Said held = said_about({{"op", "move_cp"}, {"goal", {1, 0, 0, 1, 0, 0, 0}}, {"hold", Json::array()}}, &kMicro);
  EXPECT_EQ(held.code, "refused");
  EXPECT_TRUE(names(held.text, {"hold", "robot micro", "serial"}));
}

TEST(RequestCheck, WhoMayAskAndForWhichArmStandsInTheTable) {
  const auto said = [](const char* op, Role role, const RequestBounds& bounds) {
    return said_by([&] { require_may(*find_request(op), role, bounds); });
  };
  EXPECT_EQ(said("acquire", Role::kClient, kZhu).code, "accepted");
  const Said observed = said("acquire", Role::kObserver, kZhu);
  EXPECT_EQ(observed.code, "not_owner");
  EXPECT_TRUE(names(observed.text, {"acquire", "observer", "mission", "client"}));
  EXPECT_EQ(said("camera", Role::kClient, kZhu).code, "bad_request");
  EXPECT_EQ(said("stop", Role::kCamera, kMicro).code, "accepted");
  for (const char* op : {"hold_theta", "shape", "use_device"}) {
    EXPECT_EQ(said(op, Role::kMission, kZhu).code, "accepted");
    EXPECT_EQ(said(op, Role::kMission, kMicro).code, "refused");
    EXPECT_TRUE(names(said(op, Role::kMission, kMicro).text, {op, "robot micro", "serial"}));
  }
}

TEST(RequestCheck, WithoutARobotNamesAndTypesAloneAreChecked) {
  EXPECT_EQ(said_about({{"op", "move_jp"}, {"goal_deg", {0, 500}}}, nullptr).code, "accepted");
  const Said text = said_about({{"op", "move_jp"}, {"goal_deg", {0, "a"}}}, nullptr, 1);
  EXPECT_EQ(text.code, "bad_request");
  EXPECT_TRUE(names(text.text, {"goal_deg[2]", "a", "number"}));
}

// Every finite double on the edge of a range passes, and its neighbour outside does not.
TEST(RequestCheck, RangesIncludeTheirEndsAndNothingBeyond) {
  std::mt19937_64 draw(7);
  for (int i = 0; i < 200; ++i) {
    RequestBounds bounds = kZhu;
    const double most = std::ldexp(static_cast<double>(draw() >> 11), -40);
    bounds.angle_rate_deg_s = 0.01 + most;
    const auto rate = [&](double value) {
      return said_about({{"op", "move_jp"}, {"goal_deg", std::vector<double>(10, 0.0)}, {"rate_deg_s", value}},
                        &bounds);
    };
    EXPECT_EQ(rate(bounds.angle_rate_deg_s).code, "accepted");
    EXPECT_EQ(rate(std::nextafter(bounds.angle_rate_deg_s, INFINITY)).code, "out_of_range");
  }
}

TEST(RequestCheck, NotANumberAndInfinityNeverPass) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const Json goal{bad, 0, 0, 1, 0, 0, 0};
    EXPECT_EQ(said_about({{"op", "move_cp"}, {"goal", goal}}, &kZhu).code, "out_of_range");
  }
}

TEST(RequestCheck, AQuaternionHasLengthOneWithinAMillionth) {
  const auto said = [](double qw) { return said_about({{"op", "servo_cp"}, {"goal", {1, 0, 0, qw, 0, 0, 0}}}, &kZhu); };
  EXPECT_EQ(said(1 + 0.9e-6).code, "accepted");
  EXPECT_TRUE(names(said(1 + 2e-6).text, {"goal", "quaternion"}));
  EXPECT_TRUE(names(said(0.9).text, {"goal", "1e-6"}));
}

TEST(Arguments, HoldWhatWasGivenAndTheDefaultsOfTheRest) {
  const Json request = Json::parse(R"({"op":"shape","nodes":[{"node":3,"position_m":[1,2,3]}]})");
  const Arguments shape = checked(row_of(request), request, kZhu);
  ASSERT_EQ(shape.entries("nodes").size(), 1u);
  const Arguments node = shape.entries("nodes")[0];
  EXPECT_EQ(node.integer("node"), 3);
  EXPECT_EQ(node.point("position_m"), (Vec3{1, 2, 3}));
  EXPECT_EQ(node.number("threshold_m"), 0.01);
  EXPECT_FALSE(node.has("weight"));
  EXPECT_THROW(node.number("weight"), std::logic_error) << "it has no default";
  EXPECT_TRUE(shape.entries("keep_clear").empty());
  EXPECT_FALSE(shape.flag("search"));
  EXPECT_THROW(shape.has("serach"), std::logic_error) << "not in the table";
}

TEST(Arguments, DefaultsMayBeFiguresOfTheRobot) {
  const Json request{{"op", "move_jp"}, {"goal_deg", std::vector<double>(7, 0.0)}};
  EXPECT_EQ(checked(row_of(request), request, kMicro).number("rate_deg_s"), 4.0);
}

TEST(RequestTable, EveryRowAndFieldHasASentenceAndAUniqueName) {
  std::vector<std::string> ops;
  const std::function<void(std::span<const RequestField>)> look = [&](std::span<const RequestField> fields) {
    std::vector<std::string> names;
    for (const RequestField& field : fields) {
      EXPECT_EQ(std::count(names.begin(), names.end(), field.name), 0) << field.name;
      EXPECT_GT(std::string(field.doc).size(), 4u) << field.name;
      names.push_back(field.name);
      look(field.fields);
    }
  };
  for (const RequestRow& row : request_table()) {
    EXPECT_EQ(std::count(ops.begin(), ops.end(), row.op), 0) << row.op;
    EXPECT_TRUE(std::string(row.doc).ends_with(".")) << row.op;
    EXPECT_TRUE(!row.owner_only || row.roles == kAnyRole) << row.op << ": who may own, acquire says";
    ops.push_back(row.op);
    look(row.fields);
  }
}

}  // namespace
}  // namespace liana::api
