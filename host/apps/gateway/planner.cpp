#include "host/apps/gateway/planner.hpp"

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "host/api/server/request_check.hpp"
#include "host/api/server/request_error.hpp"
#include "host/api/server/request_table.hpp"

namespace liana::gateway {
namespace {

using api::RequestError;

constexpr std::array kPlanFields{
    api::RequestField{"goal_deg", api::FieldType::kAngles, "where the way ends"},
    api::RequestField{"number", api::FieldType::kInteger, "of this goal: each message about it has it", {0}, {1e9}},
};
constexpr int kReadLines = 1000;  // of the log
constexpr api::RequestRow kPlanRow{.op = "plan", .fields = kPlanFields};

constexpr const char* kFolderOfPlan = "liana-plan-";

std::string new_folder() {
  std::string name = (std::filesystem::temp_directory_path() / (std::string(kFolderOfPlan) + "XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr)
    throw std::runtime_error(name + ": no temporary folder can be made; free space there or set TMPDIR");
  return name;
}

void write(const std::string& file, const std::string& text) {
  std::ofstream out(file);
  if (!(out << text << std::flush)) throw std::runtime_error(file + ": cannot be written; free space there");
}

bool owns(const std::string& client, const Json& state) { return state.member_or_null("owner") == client; }

std::string listed(const Json& angles_deg) {
  std::string list;
  for (const Json& angle_deg : angles_deg) list += (list.empty() ? "" : ",") + angle_deg.dump();
  return list;
}

// What verification asks for: less would be planned in vain.
double margin_m(const Json& scene) {
  const Json& margins = scene.member_or_null("margins");
  return margins.value("prediction_m", 0.0) + margins.value("refuse_m", 0.0);
}

// "found" of a solved plan.
Json found(const Json& plan, const Json& from_deg) {
  const Json& checked = plan.at("checked");
  const bool is_near = checked.at("nearest") != "";
  return {{"phase", "found"},
          {"from_deg", from_deg},
          {"points_deg", plan.at("waypoints_deg")},
          {"duration_s", checked.at("duration_s")},
          {"min_clearance_m", is_near ? checked.at("min_clearance_m") : Json()},
          {"nearest", checked.at("nearest")}};
}

Json none(const std::string& text) { return {{"phase", "none"}, {"text", text}}; }

// How the planner's answer is told. Throws JsonError when it is none.
Json ending(const Json& answer, const Json& from_deg) {
  if (answer.contains("error")) return none("The planner refused: " + answer["error"].at("text").text());
  const std::string outcome = answer.at("outcome");
  if (outcome == "solved" && answer.at("waypoints_deg").size() <= Planner::kMaxPoints) return found(answer, from_deg);
  const std::string why = answer.value("reason", outcome) + ".";
  return none((outcome == "infeasible" ? "There is no way: " : "No way was found: ") + why);
}

// The answer is the line of the log that is JSON; the others tell of progress.
Json answer_in(const std::string& log) {
  const std::size_t begin = log.starts_with("{") ? 0 : log.find("\n{");
  if (begin == std::string::npos) return {};
  const std::size_t line = log.find('{', begin);
  return Json::parse_or_null(log.substr(line, log.find('\n', line) - line));
}

}  // namespace

Planner::Planner(std::string program, Say say) : program_(std::move(program)), say_(std::move(say)) {
  launcher::remove_leftovers(kFolderOfPlan);
}

Planner::~Planner() { forget(); }

void Planner::start(const Json& request, const Json& welcome, const Json& state, const std::string& client,
                    double now_s) {
  if (is_running()) throw RequestError("busy", "a way is being planned: end that first");
  if (state.is_null()) throw RequestError("away", "lianad is not there: no way can be planned");
  const Json& robot = welcome.at("robot");
  const api::RequestBounds bounds = api::request_bounds(robot);
  if (bounds.arm != api::kCableArm) throw RequestError("refused", "the planner is for cable arms: move by other ways");
  if (!owns(client, state)) throw RequestError("not_owner", "only the owner of motion plans a way");
  if (state.member_or_null("at_rest") != true || state.member_or_null("is_busy") != false)
    throw RequestError("refused", "the arm moves: plan when it is at rest");
  const api::Arguments fields = api::checked(kPlanRow, request, bounds);
  from_deg_ = state.member_or_null("setpoint_js_deg");
  if (from_deg_.size() != bounds.angle_deg.size())
    throw RequestError("refused", "where the arm stands is not known: home it first");
  try {
    folder_ = new_folder();
    lock_ = launcher::hold_new_folder(folder_, "");
    const std::string robot_file = folder_ + "/robot.json", scene_file = folder_ + "/scene.json";
    write(robot_file, robot.dump());
    write(scene_file, welcome.at("scene").dump());
    const std::vector<std::string> argv{program_,
                                        "plan",
                                        "--robot=" + robot_file,
                                        "--scene=" + scene_file,
                                        "--from-deg=" + listed(from_deg_),
                                        "--to-deg=" + listed(fields.json().at("goal_deg")),
                                        "--margin=" + std::to_string(margin_m(welcome.at("scene"))),
                                        "--json"};
    child_ = std::make_unique<launcher::ChildProcess>("liana plan", argv, folder_ + "/log");
  } catch (const std::runtime_error& error) {
    forget();
    throw RequestError("refused", error.what());
  }
  number_ = fields.integer("number");
  since_s_ = said_s_ = now_s;
}

void Planner::end(const std::string& why) {
  if (!is_running()) return;
  forget();
  say(none(why));
}

void Planner::tick(const Json& state, const std::string& client, double now_s) {
  if (!is_running()) return;
  if (const auto status = child_->poll()) return finish(*status);
  if (!owns(client, state)) return end("Motion is no longer yours: the planner was ended.");
  if (now_s - since_s_ > kPatience_s)
    return end("No way was found within " + std::to_string(static_cast<int>(kPatience_s)) +
               " s. Go a part of the way first, or choose another goal.");
  if (now_s - said_s_ >= kBetween_s) say_progress(now_s);
}

void Planner::say_progress(double now_s) {
  said_s_ = now_s;
  std::string line = child_->last_lines(1);
  if (line.starts_with("plan: ")) line.erase(0, 6);
  say({{"phase", "planning"}, {"for_s", std::round(now_s - since_s_)}, {"text", line}});
}

void Planner::finish(const launcher::ExitStatus& status) {
  const std::string log = child_->last_lines(kReadLines), last = child_->last_lines(1);
  forget();
  try {
    say(ending(answer_in(log), from_deg_));
  } catch (const JsonError&) {
    say(none("The planner " + how(status) + ": " + last));
  }
}

void Planner::say(Json message) {
  message["op"] = "plan";
  message["number"] = number_;
  say_(message);
}

void Planner::forget() {
  child_.reset();
  if (folder_.empty()) return;
  std::error_code ignored;
  std::filesystem::remove_all(std::exchange(folder_, ""), ignored);
  lock_.reset();
}

}  // namespace liana::gateway
