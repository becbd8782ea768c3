#include <cmath>
#include <cstdio>

#include "firmware_like/math/trig.hpp"
#include "host/cli/arguments.hpp"
#include "host/cli/commands.hpp"
#include "host/json/json.hpp"
#include "host/simulate/simulation.hpp"
#include "host/simulate/straight_way.hpp"
#include "host/system/tables.hpp"
#include "host/verify/judge_simulated.hpp"
#include "host/verify/refusal_table.hpp"

namespace liana::cli {
namespace {

constexpr double kLongest_s = 600.0;

// Whatever the angles are: those beyond their limits are what verification refuses.
cable::ThetaVector any_angles(const char* option, const std::string& text, const cable::RobotTable& table) {
  const std::vector<double> angles_deg = parse_numbers(option, text, static_cast<std::size_t>(table.theta_count()));
  cable::ThetaVector theta_rad{};
  for (std::size_t k = 0; k < angles_deg.size(); ++k) {
    if (std::fabs(angles_deg[k]) > 360.0)
      throw system::BadInput(std::string(option) + ": '" + text + "': allowed: angles within +-360 deg");
    theta_rad[k] = angles_deg[k] * kDegree;
  }
  return theta_rad;
}

verify::Verdict verdict_of(const config::RobotConfig& robot, const config::SceneConfig& scene,
                           const simulate::JointSequence& way) {
  simulate::StartState start;
  start.theta_rad = way.theta_rad.front();
  simulate::Simulation simulation(simulate::arm_model(robot), scene);
  const verify::MotionRules rules{
      robot.table, scene, {scene.slit, robot.table.limits.tip_speed_slit_m_s}, robot.machine, robot.module_radius_m};
  verify::TooNear too_near;
  return verify::judge_simulated(rules, way, true, simulation.run(start, way), too_near);
}

// How near a body was; null where the scene has none.
Json clearance_of(const verify::Verdict& verdict) {
  return verdict.first.body.empty() ? Json() : Json(verdict.margins.clearance_m);
}

Json json_of(const verify::Verdict& verdict) {
  const bool refused = !verdict.passed();
  Json out = {{"accepted", !refused},
              {"error", nullptr},
              {"slowly", verdict.slowly},
              {"inside", verdict.margins.clearance_m < 0.0},
              {"margins",
               {{"clearance_m", clearance_of(verdict)},
                {"joint_deg", verdict.margins.joint_deg},
                {"rate_deg_s", verdict.margins.rate_deg_s},
                {"tension_N", verdict.margins.tension_N},
                {"time_us", verdict.margins.time_us}}},
              {"first", {{"body", verdict.first.body}, {"time_s", verdict.first.time_s}}},
              {"remedy", nullptr}};
  if (refused) {
    const verify::RefusalRow& row = verify::row_of(verdict.code);
    out["error"] = {{"code", static_cast<int>(verdict.code)}, {"name", row.name}, {"text", verdict.text}};
    out["remedy"] = row.remedy;
  }
  return out;
}

void print_summary(const verify::Verdict& verdict) {
  if (verdict.passed()) {
    std::printf("accepted%s\n", verdict.slowly ? ", to be carried out slowly" : "");
  } else {
    const verify::RefusalRow& row = verify::row_of(verdict.code);
    std::printf("refused: %d %s: %s; %s\n", static_cast<int>(verdict.code), row.name, verdict.text.c_str(), row.remedy);
  }
  const verify::Margins& left = verdict.margins;
  std::printf("left: ");
  if (!verdict.first.body.empty()) std::printf("clearance %.1f mm, ", 1000.0 * left.clearance_m);
  std::printf("angle %.3f deg, rate %.3f deg/s, tension %.1f N, time of a tick %.0f us\n", left.joint_deg,
              left.rate_deg_s, left.tension_N, left.time_us);
  if (left.clearance_m < 0.0)
    std::printf("inside: the arm is in a body on this way; only motion that leads out is let through\n");
  if (!verdict.first.body.empty())
    std::printf("first: %s at %.2f s\n", verdict.first.body.c_str(), verdict.first.time_s);
}

}  // namespace

int verify_command(const VerifyOptions& options) {
  if (system::serial_robot_for_kinematics(options.robot))
    throw system::BadInput(
        "--robot: '" + options.robot +
        "': allowed: a cable arm; serial arms have no simulation with a scene yet: look with liana check "
        "of a mission");
  const config::RobotConfig robot = system::robot_for_kinematics(options.robot);
  const config::SceneConfig scene = system::scene_of(options.scene);
  const double interval_s = robot.table.interval_ticks * robot.table.tick_s;
  const double duration_s = parse_number_in("--duration", options.duration_s, interval_s, kLongest_s, "s");
  const simulate::JointSequence way =
      simulate::straight_way(robot.table, any_angles("--from-deg", options.from_deg, robot.table),
                             any_angles("--to-deg", options.to_deg, robot.table), duration_s, interval_s);
  const verify::Verdict verdict = verdict_of(robot, scene, way);
  if (options.json) {
    std::puts(json_of(verdict).dump().c_str());
  } else {
    print_summary(verdict);
  }
  return 0;
}

}  // namespace liana::cli
