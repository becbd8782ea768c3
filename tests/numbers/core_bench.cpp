// How long the stages of a tick take on this machine: the worst case beside the mean. `--json` for programs.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "firmware_like/motion/goal_ik.hpp"
#include "tests/firmware_like/ideal_drives.hpp"

namespace liana {
namespace {

constexpr int kRounds = 5000;

struct Timing {
  std::string name;
  double mean_us = 0.0;
  double p99_us = 0.0;
  double worst_us = 0.0;
};

Timing measure(const std::string& name, const std::function<void()>& call) {
  std::vector<double> microseconds;
  for (int i = 0; i < kRounds; ++i) {
    const auto start = std::chrono::steady_clock::now();
    call();
    microseconds.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
  std::sort(microseconds.begin(), microseconds.end());
  double sum = 0.0;
  for (const double value : microseconds) sum += value;
  return {name, sum / kRounds, microseconds[kRounds * 99 / 100], microseconds.back()};
}

// The tip moves to and fro, so that every stage has work to do.
void steer(Rig& rig, double& direction) {
  if (rig.now % 500 == 0) {
    direction = -direction;
    rig.tick(Request::kNone, rig.release(rig.tip_by({0.05 * direction, 0.03 * direction, 0.0})));
  } else {
    rig.tick();
  }
}

std::vector<Timing> measure_all() {
  Rig rig;
  const ThetaVector theta = zhu2022::radians(zhu2022::kPrepare_deg);
  const ArmTrig trig = arm_trig(rig.robot, theta);
  const CableLayout layout = cable_layout(rig.robot);
  GoalIkProblem problem;
  problem.tip_in_base = forward_kinematics(rig.robot, theta).tip_in_base;
  volatile double sink = 0.0;  // keeps results alive
  std::vector<Timing> timings;
  timings.push_back(
      measure("kinematics and 6x10 Jacobian", [&] { sink = forward_kinematics(rig.robot, theta).tip_in_base.position_m[0]; }));
  timings.push_back(measure("15 cable lengths and derivative", [&] { sink = cable_geometry(rig.robot, layout, trig).length_m[0]; }));
  timings.push_back(measure("goal IK from zero", [&] { sink = solve_goal(rig.robot, problem).position_error_m; }));
  timings.push_back(measure("tick, drives off", [&] { rig.tick(); }));
  rig.enable();
  double direction = 1.0;
  timings.push_back(measure("tick, tip moving", [&] { steer(rig, direction); }));
  return timings;
}

void print(const std::vector<Timing>& timings, bool json) {
  if (!json) std::printf("%-34s %9s %9s %9s  (us, %d rounds)\n", "", "mean", "p99", "worst", kRounds);
  for (std::size_t i = 0; i < timings.size(); ++i) {
    const Timing& one = timings[i];
    const char* format = json ? "%s{\"name\":\"%s\",\"mean_us\":%.2f,\"p99_us\":%.2f,\"worst_us\":%.2f}" : "%s%-34s %9.2f %9.2f %9.2f\n";
    std::printf(format, !json ? "" : i == 0 ? "[" : ",", one.name.c_str(), one.mean_us, one.p99_us, one.worst_us);
  }
  if (json) std::puts("]");
}

}  // namespace
}  // namespace liana

int main(int argc, char** argv) {
  liana::print(liana::measure_all(), argc > 1 && std::string(argv[1]) == "--json");
  return 0;
}
