#include <cmath>
#include <cstdio>
#include <optional>
#include <string>

#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/apps/report/line.hpp"
#include "host/base/json/json.hpp"
#include "host/control/verification/arm_limits.hpp"
#include "host/control/verification/judge_serial.hpp"
#include "host/control/verification/judge_simulated.hpp"
#include "host/control/verification/refusal_table.hpp"
#include "host/model/simulation/serial_simulation.hpp"
#include "host/model/simulation/simulation.hpp"
#include "host/model/simulation/straight_way.hpp"

namespace liana::cli {
namespace {

constexpr double kLongest_s = 600.0;
constexpr double kMaxAngle_deg = 720.0;
constexpr double kSerialInterval_s = 0.02;

// A word is the name of a pose.
template <class Robot>
std::vector<double> angles_deg_of(const char* option, const std::string& text, const Robot& robot, std::size_t count) {
  const auto named = robot.named_poses_deg.find(text);
  if (named != robot.named_poses_deg.end()) return named->second;
  if (text.find(',') != std::string::npos) return parse_numbers(option, text, count);
  refuse_pose(option, text, count, robot.name, robot.named_poses_deg);
}

// Whatever the angles are: those beyond their limits are what verification refuses.
template <class Joints, class Robot>
Joints any_angles(const char* option, const std::string& text, const Robot& robot, std::size_t count) {
  const std::vector<double> angles_deg = angles_deg_of(option, text, robot, count);
  Joints joint_rad{};
  for (std::size_t k = 0; k < angles_deg.size(); ++k) {
    if (std::fabs(angles_deg[k]) > kMaxAngle_deg)
      throw launcher::BadInput(std::string(option) + ": '" + text + "': allowed: angles within +-720 deg");
    joint_rad[k] = angles_deg[k] * kDegree;
  }
  return joint_rad;
}

template <class Joints, class Robot>
auto way_of(const VerifyOptions& options, const Robot& robot, std::size_t joints, double interval_s) {
  const double duration_s = parse_number_in("--duration", options.duration_s, interval_s, kLongest_s, "s");
  const Joints from_rad = any_angles<Joints>("--from-deg", options.from_deg, robot, joints);
  const Joints to_rad = any_angles<Joints>("--to-deg", options.to_deg, robot, joints);
  return simulation::straight_way(robot.table, from_rad, to_rad, duration_s, interval_s);
}

cable::Outputs at_rest(const cable::RobotParams& table, const cable::ThetaVector& theta_rad) {
  const cable::ArmTrig trig = arm_trig(table, theta_rad);
  cable::Outputs outputs;
  outputs.theta_command_rad = theta_rad;
  outputs.load_Nm = static_load_Nm(table, theta_rad, trig, forward_kinematics(table, trig));
  return outputs;
}

verification::Verdict verdict_of(const VerifyOptions& options, const config::RobotConfig& robot,
                                 const config::SceneConfig& scene) {
  const double interval_s = robot.table.interval_ticks * robot.table.tick_s;
  const auto thetas = static_cast<std::size_t>(robot.table.theta_count());
  const simulation::JointSequence way = way_of<cable::ThetaVector>(options, robot, thetas, interval_s);
  simulation::StartState start;
  start.theta_rad = way.rows_rad.front();
  simulation::Simulation simulation(simulation::arm_model(robot), scene);
  const verification::MotionRules rules{
      robot.table, scene, {scene.slit, robot.table.limits.tip_speed_slit_m_s}, robot.machine, robot.module_radius_m};
  verification::TooNear too_near;
  verification::SimulationVerdict verdict =
      verification::judge_simulated(rules, way, true, simulation.run(start, way), too_near);
  verification::Judge judge(verdict, &robot.table);
  judge_hold(robot.table, at_rest(robot.table, way.rows_rad.front()), at_rest(robot.table, way.rows_rad.back()), judge);
  judge.conclude();
  return verdict;
}

// No buses say how long a command interval is, and nothing but how finely the motion is looked at hangs on it.
verification::Verdict verdict_of(const VerifyOptions& options, const config::SerialRobotConfig& robot,
                                 const config::SceneConfig& scene) {
  const auto way = way_of<serial::JointVector>(options, robot, robot.table.joints(), kSerialInterval_s);
  simulation::SerialSimulation simulation(launcher::checked([&] { return simulation::serial_model(robot, scene); }),
                                          scene);
  verification::TooNear too_near;
  verification::SimulationVerdict verdict;
  verdict.margins = verification::margins_unknown();
  verification::judge_serial(robot.table, simulation, way, simulation.run(way.rows_rad.front(), way, options.carrying),
                             too_near, verdict);
  return verdict;
}

// Null where nobody looked at it.
Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

// How near a body was; null where the scene has none.
Json clearance_of(const verification::Verdict& verdict) {
  return verdict.first.body.empty() ? Json() : number_or_null(verdict.margins.clearance_m);
}

Json json_of(const verification::Verdict& verdict) {
  const bool refused = !verdict.passed();
  Json out = {{"accepted", !refused},
              {"error", nullptr},
              {"slowly", verdict.slowly},
              {"inside", verdict.margins.clearance_m < 0.0},
              {"touches_itself", verdict.touches_itself.empty() ? Json() : Json(verdict.touches_itself)},
              {"margins",
               {{"clearance_m", clearance_of(verdict)},
                {"joint_deg", number_or_null(verdict.margins.joint_deg)},
                {"rate_deg_s", number_or_null(verdict.margins.rate_deg_s)},
                {"tension_N", number_or_null(verdict.margins.tension_N)},
                {"time_us", number_or_null(verdict.margins.time_us)}}},
              {"first", {{"body", verdict.first.body}, {"time_s", verdict.first.time_s}}},
              {"remedy", nullptr}};
  if (refused) {
    const verification::RefusalRow& row = verification::row_of(verdict.code);
    out["error"] = {{"code", static_cast<int>(verdict.code)}, {"name", row.name}, {"text", verdict.text}};
    out["remedy"] = row.remedy;
  }
  return out;
}

// What is left of a limit.
struct Left {
  const char* what;
  double value;
  int digits;
  const char* unit;
};

void print_summary(const verification::Verdict& verdict) {
  if (verdict.passed()) {
    std::printf("accepted%s\n", verdict.slowly ? ", to be carried out slowly" : "");
  } else {
    const verification::RefusalRow& row = verification::row_of(verdict.code);
    std::printf("refused: %s. %s [%d %s]\n", verdict.text.c_str(), row.remedy, static_cast<int>(verdict.code),
                row.name);
  }
  const verification::Margins& left = verdict.margins;
  const double clearance_mm = verdict.first.body.empty() ? std::nan("") : 1000.0 * left.clearance_m;
  const Left shown[] = {{"clearance", clearance_mm, 1, "mm"},
                        {"angle", left.joint_deg, 3, "deg"},
                        {"rate", left.rate_deg_s, 3, "deg/s"},
                        {"tension", left.tension_N, 1, "N"},
                        {"time of a tick", left.time_us, 0, "us"}};
  std::string text;
  for (const Left& each : shown) {
    if (!std::isfinite(each.value)) continue;
    text += (text.empty() ? "" : ", ") + report::line("%s %.*f %s", each.what, each.digits, each.value, each.unit);
  }
  if (!text.empty()) std::printf("left: %s\n", text.c_str());
  if (verdict.passed() && left.clearance_m < 0.0)
    std::printf(
        "too near: less is left than has to be; only motion that leads away is let through, as this one does\n");
  if (!verdict.touches_itself.empty())
    std::printf("touches itself from the start: %s; only motion that leads apart is let through, as this one does\n",
                verdict.touches_itself.c_str());
  if (!verdict.first.body.empty())
    std::printf("first: %s at %.2f s\n", verdict.first.body.c_str(), verdict.first.time_s);
}

}  // namespace

int verify_command(const VerifyOptions& options) {
  const std::optional<config::SerialRobotConfig> serial = launcher::serial_robot_for_kinematics(options.robot);
  const config::SceneConfig scene = launcher::scene_of(!options.scene.empty() ? options.scene
                                                       : serial               ? "none"
                                                                              : "panel_slit");
  if (options.carrying && !scene.payload)
    throw launcher::BadInput("--carrying: scene " + scene.name + " has no payload; name one that has (--scene)");
  if (options.carrying && !serial)
    throw launcher::BadInput("--carrying: robot " + options.robot + " has cables and carries no payload; leave it out");
  const verification::Verdict verdict = serial
                                            ? verdict_of(options, *serial, scene)
                                            : verdict_of(options, launcher::robot_for_kinematics(options.robot), scene);
  if (options.json) {
    std::puts(json_of(verdict).dump().c_str());
  } else {
    print_summary(verdict);
  }
  return 0;
}

}  // namespace liana::cli
