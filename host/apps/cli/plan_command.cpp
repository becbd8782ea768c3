#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "firmware_like/math/trig.hpp"
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/curve_file.hpp"
#include "host/apps/cli/pose_json.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/planned_path_check.hpp"
#include "host/apps/launcher/silence.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/theta_numbers.hpp"
#include "host/planning/planner/plan.hpp"

namespace liana::cli {
namespace {

constexpr double kBeyondPrediction_m = 0.003;  // what is left then
constexpr double kSilent_s = 5.0;              // nothing is said for no longer
constexpr double kTransitionShare =
    1.0 / 3.0;  // of the way, in which a held angle with another value than the start's gets there

void add_phase(const planner::HeldPhase& phase, const PlanOptions& options, planner::PlanRequest& request) {
  for (const planner::HeldPhase& other : request.held) {
    if (other.theta == phase.theta)
      throw launcher::BadInput("--planar: '" + options.planar +
                               "': allowed: angles that --hold and --planar name once");
  }
  request.held.push_back(phase);
}

// The points of a curve's file, JSON or Lua. Throws BadInput.
std::vector<Vec3> read_curve(const std::string& path) {
  const std::string name = "--follow: " + path;
  if (path.ends_with(".lua"))
    return launcher::checked([&] { return parse_curve(launcher::evaluate_table("curve", path), name); });
  std::error_code unreadable;
  if (!std::filesystem::is_regular_file(path, unreadable))
    throw launcher::BadInput(name + ": no such file; give a JSON or Lua file with points_m, or slit");
  return launcher::checked([&] { return parse_curve(config::read_text_file(path), name); });
}

void read_hold(const PlanOptions& options, planner::PlanRequest& request) {
  if (options.hold.empty()) return;
  for (const HoldArgument& held : parse_hold(options.hold, request.robot.table)) {
    const double at_start = request.from_rad[static_cast<std::size_t>(held.theta - 1)];
    const double value = held.has_value ? held.value_deg * kDegree : at_start;
    add_phase({held.theta - 1, value, std::fabs(value - at_start) < 1e-12 ? 0.0 : kTransitionShare}, options, request);
  }
}

// SEGMENT@SHARE,... : the segment's pitch is 0 from that share of the way on.
void read_planar(const PlanOptions& options, planner::PlanRequest& request) {
  const std::string& all = options.planar;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end + 1) {
    end = std::min(all.find(',', begin), all.size());
    const std::string_view part = std::string_view(all).substr(begin, end - begin);
    const std::size_t at = std::min(part.find('@'), part.size());
    const double segment = parse_number("--planar", part.substr(0, at));
    const double share = at < part.size() ? parse_number("--planar", part.substr(at + 1)) : 0.0;
    const bool good = segment >= 1 && segment <= request.robot.table.segment_count && segment == std::floor(segment) &&
                      share >= 0 && share <= 1;
    if (!good)
      throw launcher::BadInput("--planar: '" + std::string(part) +
                               "': allowed: SEGMENT@SHARE, a segment of the robot and a share from 0 to 1");
    add_phase({2 * static_cast<std::int32_t>(segment) - 2, 0.0, share}, options, request);
  }
}

// The end of a held angle must be the goal's.
void check_held_goal(const planner::PlanRequest& request) {
  for (const planner::HeldPhase& phase : request.held) {
    const auto k = static_cast<std::size_t>(phase.theta);
    const std::string name = "theta " + std::to_string(phase.theta + 1);
    if (request.to_rad && std::fabs((*request.to_rad)[k] - phase.value_rad) > 1e-12) {
      throw launcher::BadInput("--to-deg: " + name + " is " + std::to_string((*request.to_rad)[k] / kDegree) +
                               ": allowed: the value at which it is held, " +
                               std::to_string(phase.value_rad / kDegree));
    }
    if (phase.from_share == 0.0 && std::fabs(request.from_rad[k] - phase.value_rad) > 1e-12) {
      throw launcher::BadInput("--planar: " + name + " is " + std::to_string(request.from_rad[k] / kDegree) +
                               " at the start: allowed: a share over 0, in which it can reach 0");
    }
  }
}

void read_follow(const PlanOptions& options, planner::PlanRequest& request) {
  if (options.follow.empty()) return;
  const auto refuse = [](const std::string& option, const char* why) {
    throw launcher::BadInput(option + ": not with --follow: " + why);
  };
  if (!options.planar.empty()) refuse("--planar", "the curve says where the arm is; leave it out");
  if (!options.control_points.empty()) refuse("--control-point", "the curve says where the arm is; leave it out");
  if (!options.max_iterations.empty()) refuse("--iterations", "nothing is solved by Ipopt there; leave it out");
  if (!options.waypoints.empty()) refuse("--waypoints", "as many as the tip needs come out; leave it out");
  if (options.hold.find('=') != std::string::npos)
    refuse("--hold with values", "name the angles alone, which keep what they have");
  request.follow.emplace();
  if (options.follow != "slit") {
    if (!options.to_deg.empty() || !options.tip.empty())
      refuse("--to-deg, --tip", "the curve's end is the goal; leave them out");
    request.follow->points_m = read_curve(options.follow);
  } else if (!request.scene.slit) {
    throw launcher::BadInput("--follow: slit: the scene '" + options.scene +
                             "' has none; give a --scene with a slit, or a curve's file");
  }
}

void read_goal(const PlanOptions& options, planner::PlanRequest& request) {
  read_follow(options, request);
  if (request.follow && !request.follow->points_m.empty()) return;
  if (options.to_deg.empty() == options.tip.empty())
    throw launcher::BadInput("--to-deg, --tip: allowed: exactly one of them");
  if (!options.to_deg.empty()) request.to_rad = parse_pose_deg("--to-deg", options.to_deg, request.robot);
  if (!options.tip.empty()) request.tip_in_base = parse_pose("--tip", options.tip);
  if (request.tip_in_base) request.tip_in_base->quaternion = normalize(request.tip_in_base->quaternion);
}

void read_sizes(const PlanOptions& options, planner::PlanRequest& request) {
  constexpr double kMinStep_deg = 0.001;
  const std::int64_t fewest = request.tip_in_base ? 1 : 2;
  const char* note = request.tip_in_base ? "; 1: the end pose alone" : "; 1, the end pose alone, is for --tip";
  if (!options.waypoints.empty())
    request.waypoints =
        static_cast<std::int32_t>(parse_whole("--waypoints", options.waypoints, fewest, planner::kMaxWaypoints, note));
  request.margin_m = parse_number_in("--margin", options.margin_m, 0.0, 0.5, "m");
  request.max_step_rad =
      options.max_step_deg.empty()
          ? (request.follow ? planner::kFollowMaxStep_rad
                            : planner::default_max_step_rad(request.robot.table, request.waypoints))
          : parse_number_in("--max-step-deg", options.max_step_deg, kMinStep_deg, 180.0, "deg") * kDegree;
}

void read_control_points(const PlanOptions& options, planner::PlanRequest& request) {
  if (options.control_points.size() > planner::kMaxControlPoints) {
    throw launcher::BadInput("--control-point: " + std::to_string(options.control_points.size()) +
                             " given: allowed: at most " + std::to_string(planner::kMaxControlPoints));
  }
  for (const std::string& text : options.control_points) {
    const ControlPointArgument point = parse_control_point(text, request.robot.table);
    request.control_points.push_back({point.node, point.position_m, point.weight});
  }
}

planner::PlanRequest request_of(const PlanOptions& options) {
  planner::PlanRequest request;
  request.robot = launcher::robot_for_kinematics(options.robot);
  request.scene = launcher::scene_of(options.scene);
  request.from_rad = parse_pose_deg("--from-deg", options.from_deg, request.robot);
  read_goal(options, request);
  read_hold(options, request);
  read_planar(options, request);
  check_held_goal(request);
  read_control_points(options, request);
  read_sizes(options, request);
  return request;
}

Json to_json(const planner::PlanRequest& request, const planner::PlanResult& result, double time_s) {
  Json waypoints = Json::array();
  for (const cable::ThetaVector& theta_rad : result.waypoints_rad)
    waypoints.push_back(degrees_json(theta_rad, request.robot.table.theta_count()));
  Json answer{{"outcome", planner::name_of(result.outcome)},
              {"waypoints_deg", waypoints},
              {"objective", result.objective},
              {"iterations", result.iterations},
              {"rounds", result.rounds},
              {"settled", result.settled},
              {"time_s", time_s},
              {"start", result.start},
              {"checked", nullptr},
              {"hash", planner::plan_hash(request, result)}};
  if (result.checked) {
    const planner::PlanCheck& check = *result.checked;
    answer["checked"] = {{"min_clearance_m", check.min_clearance_m},
                         {"nearest", check.nearest},
                         {"nearest_link", check.nearest_link},
                         {"min_self_clearance_m", check.self.clearance_m},
                         {"self_links", check.self.link},
                         {"max_joint_deg", check.max_joint_deg},
                         {"max_step_deg", check.max_step_deg},
                         {"max_cable_step_m", check.max_cable_step_m},
                         {"tip_error_m", check.tip_error_m},
                         {"tip_attitude_error_rad", check.tip_attitude_error_rad},
                         {"min_tension_N", check.min_tension_N},
                         {"max_tension_N", check.max_tension_N},
                         {"duration_s", check.duration_s},
                         {"poses", check.poses}};
  }
  if (result.follow) {
    const planner::FollowStatistics& figures = *result.follow;
    answer["follow"] = {{"curve_length_m", figures.curve_length_m},
                        {"tip_off_m", figures.tip_off_m},
                        {"body_off_m", figures.body_off_m},
                        {"mean_body_off_m", figures.mean_body_off_m},
                        {"worst_link", figures.worst_link},
                        {"worst_tip_along_m", figures.worst_tip_along_m},
                        {"curve_off_m", figures.curve_off_m},
                        {"curve_off_segment", figures.curve_off_segment},
                        {"curve_off_along_m", figures.curve_off_along_m},
                        {"curve_off_tip_along_m", figures.curve_off_tip_along_m}};
  }
  if (!result.constraint.empty()) answer["constraint"] = result.constraint;
  if (!result.reason.empty()) answer["reason"] = result.reason;
  return answer;
}

Json follow_json(const planner::PlanRequest& request) {
  if (!request.follow) return nullptr;
  return request.follow->points_m.empty() ? Json("slit") : Json{{"points_m", request.follow->points_m}};
}

// What the plan was asked for, as it was given.
Json inputs(const PlanOptions& options, const planner::PlanRequest& request) {
  return {{"robot", Json::parse(request.robot.canonical_json)},
          {"scene", Json::parse(request.scene.canonical_json)},
          {"from_deg", options.from_deg},
          {"to_deg", options.to_deg},
          {"tip", options.tip},
          {"follow", follow_json(request)},
          {"hold", options.hold},
          {"planar", options.planar},
          {"control_points", options.control_points},
          {"waypoints", request.waypoints},
          {"margin_m", request.margin_m},
          {"max_step_deg", request.max_step_rad / kDegree}};
}

void print_plan(const Json& answer) {
  std::printf("%s after %d iterations in %.2f s", answer["outcome"].get<std::string>().c_str(),
              answer["iterations"].get<int>(), answer["time_s"].get<double>());
  if (answer.contains("reason")) std::printf(": %s", answer["reason"].get<std::string>().c_str());
  std::printf("\n");
  const Json& rows = answer["waypoints_deg"];
  for (std::size_t i = 0; !rows.empty() && i < rows[0].size(); ++i)
    std::printf(" %9s", ("theta " + std::to_string(i + 1)).c_str());
  std::printf("%s", rows.empty() ? "" : "  [deg]\n");
  for (const Json& row : rows) {
    for (const Json& angle : row) std::printf(" %9.4f", angle.get<double>());
    std::printf("\n");
  }
  if (answer["outcome"] != "solved") return;
  const Json& check = answer["checked"];
  std::printf("checked: ");
  if (check["nearest"] == "") {
    std::printf("nothing in the scene");
  } else {
    std::printf("clearance %.1f mm", 1000.0 * check["min_clearance_m"].get<double>());
  }
  std::printf(", joints up to %.2f deg, steps up to %.2f deg, tip error %.1e m\n", check["max_joint_deg"].get<double>(),
              check["max_step_deg"].get<double>(), check["tip_error_m"].get<double>());
  if (!answer.contains("follow")) return;
  const Json& follow = answer["follow"];
  std::printf(
      "followed %.3f m: tip within %.1f mm of the curve, body within %.1f mm of its line at the start and the tip's "
      "path, %.1f mm on "
      "average\n",
      follow["curve_length_m"].get<double>(), 1000.0 * follow["tip_off_m"].get<double>(),
      1000.0 * follow["body_off_m"].get<double>(), 1000.0 * follow["mean_body_off_m"].get<double>());
  std::printf("farthest from curve and start line: segment %d by %.1f mm, %.3f m along the curve\n",
              follow["curve_off_segment"].get<int>(), 1000.0 * follow["curve_off_m"].get<double>(),
              follow["curve_off_along_m"].get<double>());
}

// What is planned nearer than the arm may be predicted wrongly is refused when the arm gets there.
void warn_of_refusal(const planner::PlanRequest& request, const planner::PlanResult& result) {
  const double prediction_m = request.scene.margins.prediction_m;
  if (result.outcome != planner::PlanOutcome::solved || !result.checked || result.checked->nearest.empty()) return;
  if (result.checked->min_clearance_m >= prediction_m) return;
  std::fprintf(
      stderr,
      "plan: clearance %.1f mm, but the arm may be %.1f mm nearer than predicted (margins.prediction_m of scene "
      "%s): verification may refuse the motion there; give --margin=%.3f for a plan that it lets pass\n",
      1000.0 * result.checked->min_clearance_m, 1000.0 * prediction_m, request.scene.name.c_str(),
      prediction_m + kBeyondPrediction_m);
}

// `liana run` knows a plan by the end of its name.
void check_out_file(const std::string& file) {
  launcher::check_output("--out", file);
  if (!file.ends_with(".json"))
    throw launcher::BadInput("--out: '" + file + "': allowed: a name that ends in .json: name the plan's file so");
}

int exit_code(planner::PlanOutcome outcome) {
  if (outcome == planner::PlanOutcome::solved) return launcher::kExitOk;
  return outcome == planner::PlanOutcome::cancelled ? launcher::kExitInterrupted : launcher::kExitNotConverged;
}

}  // namespace

int plan_command(const PlanOptions& options) {
  const launcher::InterruptGuard interrupt;
  planner::PlanControl control;
  if (!options.max_iterations.empty())
    control.max_iterations = static_cast<std::int32_t>(parse_whole("--iterations", options.max_iterations, 1, 100000));
  if (!options.out_file.empty()) check_out_file(options.out_file);
  const planner::PlanRequest request = request_of(options);
  launcher::Silence silence(kSilent_s, [&request](double since_s) {
    std::fprintf(stderr, "plan: computing for %.0f s, %d waypoints; Ctrl-C ends it\n", since_s, request.waypoints);
  });
  control.progress = [&silence](const std::string& line) {
    silence.broken();
    std::fprintf(stderr, "plan: %s\n", line.c_str());
  };
  control.cancelled = &interrupt.any();
  const auto begin = std::chrono::steady_clock::now();
  const planner::PlanResult result = planner::plan(request, control);
  const double time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  Json answer = to_json(request, result, time_s);
  if (options.json) {
    std::puts(answer.dump().c_str());
  } else {
    print_plan(answer);
  }
  warn_of_refusal(request, result);
  if (!options.out_file.empty() &&
      result.outcome != planner::PlanOutcome::solved) {  // an earlier plan in the file is worth more
    std::fprintf(stderr, "plan: --out: nothing was written to %s: the outcome is %s\n", options.out_file.c_str(),
                 planner::name_of(result.outcome));
  } else if (!options.out_file.empty()) {
    answer["inputs"] = inputs(options, request);
    answer["digest"] = launcher::digest_of_plan(answer);
    launcher::write_output(options.out_file, answer.dump(1) + "\n");
  }
  return exit_code(result.outcome);
}

}  // namespace liana::cli
