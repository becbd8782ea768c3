// Options of the commands that compute: pose, ik, reach, plan, budget, sweep, verify.
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"

namespace liana::cli {
namespace {

void add_pose(CLI::App& app, Action& action) {
  auto [sub, pose] = add<PoseOptions>(app, action, "pose", pose_command);
  add_robot(sub, pose.robot);
  sub.add_option("--theta-deg", pose.theta_deg, "joint angles t1,t2,... (pitch, yaw per segment), or a named pose")
      ->required();
  sub.add_option("--scene", pose.scene,
                 "scene: which segments its slit wants planar, where they begin, what their yaws may be");
  add_json(sub, pose.json);
}

void add_ik(CLI::App& app, Action& action) {
  auto [sub, ik] = add<IkOptions>(app, action, "ik", ik_command);
  add_robot(sub, ik.robot);
  sub.add_option("--from-deg", ik.from_deg, "joint angles, or a named pose, to start from")->required();
  sub.add_option("--tip", ik.tip, "goal x,y,z,qw,qx,qy,qz")->required();
  sub.add_option("--hold", ik.hold,
                 "joint angles held still, e.g. 7,9 or 7=0.5,9 (deg; at --from-deg where no value is given)");
  add_control_points(sub, ik.control_points);
  add_json(sub, ik.json);
}

void add_reach(CLI::App& app, Action& action) {
  auto [sub, reach] = add<ReachOptions>(app, action, "reach", reach_command);
  add_robot(sub, reach.robot);
  sub.add_option("--scene", reach.scene, "scene table drawn to scale; takes nothing away from the region");
  sub.add_option("--hold", reach.hold,
                 "cable arms: joint angles held still, e.g. 7,9 or 7=0.5,9 (deg; at --from-deg or 0 without a value)");
  sub.add_option("--from-deg", reach.from_deg,
                 "joint angles, or a named pose, that are drawn, or where the path begins");
  sub.add_option("--to-deg", reach.to_deg, "cable arms: joint angles, or a named pose, where the path ends");
  sub.add_option("--path", reach.path, "cable arms: JSON file with waypoints_deg, as plan --json prints it");
  sub.add_option("--node", reach.node,
                 "the end of that segment, or of that joint's link, whose region is wanted; the tip where not given");
  sub.add_flag(
      "--carry", reach.carry,
      "cable arms: what the cables pull over the region with gravity from every side, and the largest payload");
  sub.add_option("--samples", reach.samples, "poses drawn")->capture_default_str();
  add_seed(sub, reach.seed, "of the poses drawn");
  sub.add_option("--svg", reach.svg_file, "write the picture to this file");
  add_json(sub, reach.json);
}

void add_plan(CLI::App& app, Action& action) {
  auto [sub, plan] = add<PlanOptions>(app, action, "plan", plan_command);
  add_robot(sub, plan.robot);
  sub.add_option("--scene", plan.scene, "scene table: a name under lua/scenes, a file, or none")->capture_default_str();
  sub.add_option("--from-deg", plan.from_deg, "joint angles, or a named pose, to start from")->required();
  sub.add_option("--to-deg", plan.to_deg, "goal as joint angles, or a named pose");
  sub.add_option("--tip", plan.tip, "goal as tip pose x,y,z,qw,qx,qy,qz");
  sub.add_option(
      "--follow", plan.follow,
      "follow the leader: the tip along the curve of a JSON or Lua file (points_m), the body after it; or slit: "
      "through the scene's slit "
      "to the goal");
  sub.add_option("--hold", plan.hold,
                 "joint angles held, e.g. 7,9 or 7=0.5,9 (deg); one with another value than at the start is there "
                 "after a third of the way");
  sub.add_option(
      "--planar", plan.planar,
      "segments whose pitch is 0 from a share of the way on, e.g. 5@0.4,4@0.7; all the way where no share is given");
  add_control_points(sub, plan.control_points);
  sub.add_option("--waypoints", plan.waypoints, "waypoints with both ends, 20 where not given; 1: only the end pose");
  sub.add_option("--margin", plan.margin_m, "least clearance of every link from every obstacle, m")
      ->capture_default_str();
  sub.add_option("--max-step-deg", plan.max_step_deg,
                 "most that an angle changes between waypoints; 80 / (waypoints - 1) where not given");
  sub.add_option("--iterations", plan.max_iterations,
                 "of the solver in each round, 300 where not given; not with --follow");
  sub.add_option("--out", plan.out_file, "keep the plan with its inputs in this file, JSON");
  add_json(sub, plan.json);
}

void add_budget(CLI::App& app, Action& action) {
  auto [sub, budget] = add<BudgetOptions>(app, action, "budget", budget_command);
  sub.add_option("budget", budget.budget, "error chain: a name under lua/budgets or a file")->capture_default_str();
  sub.add_option("--draws", budget.draws, "tries of chance")->capture_default_str();
  add_seed(sub, budget.seed, "of chance");
  sub.add_option("--svg", budget.svg_file, "write the contributions as a picture to this file");
  add_json(sub, budget.json);
}

void add_sweep(CLI::App& app, Action& action) {
  auto [sub, sweep] = add<SweepOptions>(app, action, "sweep", sweep_command);
  sub.add_option("--robot", sweep.robot, "serial arm: a name under lua/robots or a file")->capture_default_str();
  sub.add_option("--from-deg", sweep.from_deg, "joint angles, or a named pose, that the tip stays at");
  sub.add_option("--svg", sweep.svg_file, "write the deflections as a picture to this file");
  add_json(sub, sweep.json);
}

void add_verify(CLI::App& app, Action& action) {
  auto [sub, verify] = add<VerifyOptions>(app, action, "verify", verify_command);
  add_robot(sub, verify.robot);
  sub.add_option("--scene", verify.scene,
                 "scene table: a name under lua/scenes or a file; panel_slit where not given, for a serial arm none");
  sub.add_option("--from-deg", verify.from_deg, "joint angles, or a named pose, where the arm stands")->required();
  sub.add_option("--to-deg", verify.to_deg, "joint angles, or a named pose, where it is told to stop")->required();
  sub.add_option("--duration", verify.duration_s, "how long that takes, s; T_c to 600")->required();
  sub.add_flag("--carrying", verify.carrying, "the scene's payload is on the tip; for serial arms");
  add_json(sub, verify.json);
}

}  // namespace

void declare_geometry(CLI::App& app, Action& action) {
  add_pose(app, action);
  add_ik(app, action);
  add_reach(app, action);
  add_plan(app, action);
  add_budget(app, action);
  add_sweep(app, action);
  add_verify(app, action);
}

}  // namespace liana::cli
