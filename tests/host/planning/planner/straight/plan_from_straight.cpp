// The planner started from the straight line in theta, for comparison with its own starts. Reads one problem as JSON
// from standard input: robot, buses and scene tables, from_deg, to_deg or tip; prints outcome, constraint, iterations
// and time_s as JSON.
#include <chrono>
#include <iostream>

#include "firmware_like/math/trig.hpp"
#include "host/base/json/json.hpp"
#include "host/planning/planner/plan.hpp"

namespace {

liana::cable::ThetaVector angles(const liana::Json& degrees) {
  liana::cable::ThetaVector theta{};
  for (std::size_t k = 0; k < degrees.size(); ++k) theta.at(k) = degrees[k].get<double>() * liana::kDegree;
  return theta;
}

liana::planner::PlanRequest request_of(const liana::Json& problem) {
  liana::planner::PlanRequest request;
  const liana::config::BusesConfig buses = liana::config::parse_buses(problem.at("buses").dump(), "buses");
  request.robot = liana::config::parse_robot(problem.at("robot").dump(), "robot", "nominal", buses);
  request.scene = liana::config::parse_scene(problem.at("scene").dump(), "scene");
  request.from_rad = angles(problem.at("from_deg"));
  if (problem.contains("to_deg")) request.to_rad = angles(problem.at("to_deg"));
  if (problem.contains("tip")) {
    const auto tip = problem.at("tip").get<std::array<double, 7>>();
    request.tip_in_base = liana::Pose{{tip[0], tip[1], tip[2]}, liana::normalize({tip[3], tip[4], tip[5], tip[6]})};
  }
  request.max_step_rad = liana::planner::default_max_step_rad(request.robot.table, request.waypoints);
  return request;
}

}  // namespace

int main() {
  const liana::planner::PlanRequest request =
      request_of(liana::Json::parse(std::string{std::istreambuf_iterator<char>(std::cin), {}}));
  liana::planner::PlanControl control;
  control.straight_start_only = true;
  const auto begin = std::chrono::steady_clock::now();
  const liana::planner::PlanResult result = liana::planner::plan(request, control);
  const double time_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::cout << liana::Json{{"outcome", liana::planner::name_of(result.outcome)},
                           {"constraint", result.constraint},
                           {"objective", result.objective},
                           {"iterations", result.iterations},
                           {"time_s", time_s}}
            << "\n";
}
