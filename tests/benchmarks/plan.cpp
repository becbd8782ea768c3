// Whole plans: ours, and Ipopt alone from the straight line in theta, on the same problems with the same derivatives
// and constraints.
#include <cstdio>

#include "host/planning/planner/plan.hpp"
#include "tests/benchmarks/meter.hpp"
#include "tests/host/planning/planner/requests.hpp"

namespace liana::bench {

using namespace cable;
namespace {

constexpr std::int32_t kWaypoints = 12;

planner::PlanRequest past_a_ball() {
  config::SceneConfig scene;
  scene.spheres.push_back({"ball", {2.5, 0.0, 0.1}, 0.2});
  return planner::request_between({0, -5, 0, -5, 0, -5, 0, 0, 0, 0}, {0, 5, 0, 5, 0, 5, 0, 0, 0, 0}, scene);
}

planner::PlanRequest to_the_edge() {
  return planner::request_between(zhu2022::kPrepare_deg, zhu2022::kPanelEdge_deg, planner::panel_slit());
}

planner::PlanRequest into_the_slit() {
  return planner::request_between(zhu2022::kPanelEdge_deg, zhu2022::kPressRod_deg, planner::panel_slit());
}

void measure(Meter& meter, const std::string& operation, planner::PlanRequest request) {
  request.waypoints = kWaypoints;
  request.max_step_rad = planner::default_max_step_rad(request.robot.table, kWaypoints);
  for (const bool straight : {false, true}) {
    planner::PlanControl control;
    control.straight_start_only = straight;
    planner::PlanResult result;
    const std::string version = straight ? "ipopt_straight" : "ours";
    meter.once(operation, version, [&] {
      result = planner::plan(request, control);
      return result.objective;
    });
    if (!straight && result.outcome != planner::PlanOutcome::solved)
      throw std::runtime_error(operation + ": " + result.reason);
    meter.note(
        operation, version,
        std::string(planner::name_of(result.outcome)) + ", " + std::to_string(result.iterations) + " iterations");
  }
}

}  // namespace
}  // namespace liana::bench

int main() try {
  liana::bench::Meter meter;
  liana::bench::measure(meter, "plan_edge", liana::bench::to_the_edge());
  liana::bench::measure(meter, "plan_ball", liana::bench::past_a_ball());
  liana::bench::measure(meter, "plan_slit", liana::bench::into_the_slit());
  meter.print();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
