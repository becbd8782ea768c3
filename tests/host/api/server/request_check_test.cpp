// Requests against the table: what is refused, by name, and what handlers get of the others.
#include "host/api/server/request_check.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "host/api/server/request_error.hpp"
#include "host/api/server/request_text.hpp"
#include "tests/host/api/server/robots.hpp"

namespace liana::api {
namespace {

const RequestBounds kZhu = request_bounds(zhu2022_json()), kMicro = request_bounds(micro_json());

// "code: message", or "accepted".
std::string said_about(const Json& request, const RequestBounds* bounds, std::size_t first = 0) {
  try {
    check_fields(row_of(request), request, bounds, first);
  } catch (const RequestError& error) {
    return error.code() + ": " + error.what();
  }
  return "accepted";
}

struct Case {
  const char* request;
  const char* said;
  const char* why;
};

TEST(RequestCheck, RefusesByFieldValueAllowedRangeAndWhatToDo) {
  const std::vector<Case> cases{
      {R"({"op":"hold","id":7})", "accepted", "op and id belong to every request"},
      {R"({"op":"hold","now":true})",
       "bad_request: unknown field now = true: allowed none: correct its spelling or remove it", "no fields at all"},
      {R"({"op":"move_cp","gaol":1,"goal":[1,0,0,1,0,0,0]})",
       "bad_request: unknown field gaol = 1: allowed goal, hold, swing_s, quicker_swing_s, swing_off, sequence, "
       "time_s, ttl_s: "
       "correct its spelling or "
       "remove it",
       "a misspelt field must not pass unseen"},
      {R"({"op":"servo_cp"})", "bad_request: goal is missing: allowed [x,y,z,qw,qx,qy,qz]: add it", "required"},
      {R"({"op":"state_command","command":"fly"})",
       "bad_request: command = \"fly\": allowed enable, disable, clear, home: correct it", "a word"},
      {R"({"op":"use_device","device":"none","scale":-1})",
       "out_of_range: scale = -1: allowed 0.01 to 100: choose another value", "a constant range"},
      {R"({"op":"use_device","device":"none","speed_m_s":0.5})",
       "out_of_range: speed_m_s = 0.5: allowed 1e-04 to 0.1 m/s: choose another value", "a range of the robot"},
      {R"({"op":"use_device","device":"none","node":1.5})",
       "bad_request: node = 1.5: allowed a whole number: correct it", "no integer"},
      {R"({"op":"move_jp","goal_deg":[0,0,0,0,0,0,0,0,25,0]})",
       "out_of_range: goal_deg[8] (theta 9) = 25: allowed -20 to 20 deg: choose another value", "one angle of ten"},
      {R"({"op":"move_jp","goal_deg":[1,2,3]})",
       "bad_request: goal_deg = 3 entries: allowed an array of 10 numbers: give as many", "too few"},
      {R"({"op":"move_jp","goal_deg":[null,0,0,0,0,0,0,0,0,0]})",
       "bad_request: goal_deg[0] = null: allowed a number: correct it", "no number"},
      {R"({"op":"move_cp","goal":[3,3,0,1,0,0,0]})",
       "out_of_range: goal = 4.242641 m from the base: the arm reaches 4 m: choose a nearer one",
       "each coordinate is within"},
      {R"({"op":"move_cp","goal":[1e300,0,0,1,0,0,0]})",
       "out_of_range: goal[0] = 1e+300: allowed -4 to 4 m: choose another value", "its square would overflow"},
      {R"({"op":"hold_theta","held":[{"theta":1,"target_deg":1},{"theta":9,"target_deg":30}]})",
       "out_of_range: entry 2 of held: target_deg = 30: allowed -20 to 20 deg: choose another value", "an entry"},
      {R"({"op":"hold_theta","held":[{"theta":11,"target_deg":0}]})",
       "out_of_range: entry 1 of held: theta = 11: allowed 1 to 10: choose another value",
       "before the range of an angle that is not there is asked for"},
      {R"({"op":"hold_theta","held":9})", "bad_request: held = 9: allowed an array of at most 16 entries: correct it",
       "no list"},
      {R"({"op":"announce","step":{"index":1,"device":"vr"}})",
       "bad_request: step: name is missing: allowed a text of 1 to 120 bytes: add it", "inside an object"},
      {R"({"op":"announce","step":null})", "accepted", "null is the end of the mission"},
      {R"({"op":"device","device":"vr","samples":[]})",
       "bad_request: unknown op \"device\": docs/reference/api.md lists them all",
       "devices have a socket of their own"},
      {R"({"op":"servo_cp","goal":[1,0,0,1,0,0,0],"ttl_s":60})",
       "out_of_range: ttl_s = 60: allowed 0.05 to 10 s: choose another value", "nobody waits a minute"},
      {R"({"op":"stop","reason":7,"anything":{}})", "accepted", "a stop is never refused"},
  };
  for (const Case& c : cases) EXPECT_EQ(said_about(Json::parse(c.request), &kZhu), c.said) << c.why;
}

TEST(RequestCheck, AnUnknownOpIsNamed) {
  for (const Json& op : {Json("dance"), Json(7), Json(""), Json(std::string(5000, 'x'))}) {
    const std::string said = said_about({{"op", op}}, &kZhu);
    EXPECT_EQ(said.substr(0, 12), "bad_request:") << said;
    EXPECT_NE(said.find(op.dump().substr(0, 20)), std::string::npos) << said;
  }
}

TEST(RequestCheck, RangesAreThoseOfTheRobotThatIsServed) {
  const Json far{{"op", "move_jp"}, {"goal_deg", {0, 0, 0, 0, 0, -269, 269}}};
  EXPECT_EQ(said_about(far, &kMicro), "accepted");
  EXPECT_EQ(said_about(far, &kZhu).substr(0, 12), "bad_request:");
  EXPECT_EQ(said_about({{"op", "move_jp"}, {"goal_deg", {271, 0, 0, 0, 0, 0, 0}}}, &kMicro),
            "out_of_range: goal_deg[0] (joint 1) = 271: allowed -270 to 270 deg: choose another value");
  EXPECT_EQ(said_about({{"op", "move_cp"}, {"goal", {1, 0, 0, 1, 0, 0, 0}}, {"hold", Json::array()}}, &kMicro),
            "refused: hold: for cable arms only; robot micro has a serial arm: leave it out");
}

TEST(RequestCheck, WhoMayAskAndForWhichArmStandsInTheTable) {
  const auto said = [](const char* op, Role role, const RequestBounds& bounds) -> std::string {
    try {
      require_may(*find_request(op), role, bounds);
    } catch (const RequestError& error) {
      return error.code() + ": " + error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(said("acquire", Role::kClient, kZhu), "accepted");
  EXPECT_EQ(said("acquire", Role::kObserver, kZhu),
            "not_owner: acquire by role observer: allowed mission, client: connect with such a role");
  EXPECT_EQ(said("camera", Role::kClient, kZhu).substr(0, 12), "bad_request:");
  EXPECT_EQ(said("stop", Role::kCamera, kMicro), "accepted");
  for (const char* op : {"hold_theta", "shape", "use_device"}) {
    EXPECT_EQ(said(op, Role::kMission, kZhu), "accepted");
    EXPECT_EQ(said(op, Role::kMission, kMicro),
              std::string("refused: ") + op + ": for cable arms only; robot micro has a serial arm: leave it out");
  }
}

TEST(RequestCheck, WithoutARobotNamesAndTypesAloneAreChecked) {
  EXPECT_EQ(said_about({{"op", "move_jp"}, {"goal_deg", {0, 500}}}, nullptr), "accepted");
  EXPECT_EQ(said_about({{"op", "move_jp"}, {"goal_deg", {0, "a"}}}, nullptr, 1),
            "bad_request: goal_deg[2] = \"a\": allowed a number: correct it");
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
    EXPECT_EQ(rate(bounds.angle_rate_deg_s), "accepted");
    EXPECT_NE(rate(std::nextafter(bounds.angle_rate_deg_s, INFINITY)), "accepted");
  }
}

TEST(RequestCheck, NotANumberAndInfinityNeverPass) {
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    const Json goal{bad, 0, 0, 1, 0, 0, 0};
    EXPECT_EQ(said_about({{"op", "move_cp"}, {"goal", goal}}, &kZhu).substr(0, 13), "out_of_range:");
  }
}

TEST(RequestCheck, AQuaternionHasLengthOneWithinAMillionth) {
  const auto said = [](double qw) { return said_about({{"op", "servo_cp"}, {"goal", {1, 0, 0, qw, 0, 0, 0}}}, &kZhu); };
  EXPECT_EQ(said(1 + 0.9e-6), "accepted");
  EXPECT_NE(said(1 + 2e-6).find("quaternion"), std::string::npos);
  EXPECT_NE(said(0.9).find("1e-6"), std::string::npos);
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
