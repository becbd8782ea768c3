// recover SEED...: draft
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>
#include "firmware_like/cable/arm/kinematics.hpp"
#include "tests/closed_loop/arm_under_control.hpp"
#include "tests/closed_loop/fixture.hpp"
#include "tests/closed_loop/slit_path.hpp"

namespace liana::numbers {
namespace {
using closed_loop::ArmUnderControl;
std::vector<cable::ThetaVector> path;

void lead_out(ArmUnderControl& arm, std::size_t cable, const char* when, int seed) {
  arm.plant().loosen(cable, 1.0);
  arm.plant().take_load();
  const auto before = arm.plant().theta_rad();
  arm.wait(5.0);
  const auto l1 = arm.plant().take_load();
  const double moved = closed_loop::largest_difference_deg(before, arm.plant().theta_rad());
  const int state1 = (int)arm.outputs().state;
  const int f1 = arm.outputs().faults.count ? (int)arm.outputs().faults.fault[0].number : 0;
  arm.ask(Request::kRecover);
  arm.wait(0.5);
  const int left = arm.outputs().faults.count;
  arm.ask(Request::kEnable);
  double t = 0;
  for (; t < 70 && arm.outputs().state != OperatingState::kEnabled; t += 0.1) arm.wait(0.1);
  const auto l2 = arm.plant().take_load();
  double err0 = closed_loop::largest_difference_deg(arm.outputs().theta_command_rad, arm.plant().theta_rad());
  double joff = closed_loop::largest_difference_deg(arm.outputs().theta_command_rad, path.back());
  double retract_s = 0, contact = 0, maxN = 0;
  double maxoff = 0;
  std::size_t left_points = path.size();
  bool out = false;
  if (arm.outputs().state == OperatingState::kEnabled) {
    // join: from command to path end, then back
    double i = (double)path.size() - 1;
    cable::ThetaVector now = arm.outputs().theta_command_rad;
    const double step = 0.8 * 0.25 * arm.table().limits.theta_rate_rad_s * 0.02;
    while (i > 0 && arm.outputs().state == OperatingState::kEnabled) {
      cable::Setpoint s;
      s.kind = CommandKind::kRetract;
      cable::ThetaVector goal = path[(std::size_t)i];
      double most = 0;
      for (std::size_t k = 0; k < 10; ++k) most = std::max(most, std::fabs(goal[k] - now[k]));
      const double share = most > step ? step / most : 1.0;
      for (std::size_t k = 0; k < 10; ++k) now[k] += share * (goal[k] - now[k]);
      if (share > 0.999) i -= 0.8;
      s.joint_rad = now;
      arm.follow(0.02, [&](double) { return s; });
      retract_s += 0.02;
      maxoff = std::max(maxoff, closed_loop::largest_difference_deg(now, arm.plant().theta_rad()));
    }
    left_points = (std::size_t)i;
    out = i <= 0;
  }
  const auto l3 = arm.plant().take_load();
  contact = l3.contact_N; maxN = l3.max_motor_N;
  const double u = dot(closed_loop::scene().slit->u_axis, arm.plant().tip_in_base().position_m);
  int f2 = arm.outputs().faults.count ? (int)arm.outputs().faults.fault[0].number : 0;
  int i2 = arm.outputs().faults.count ? (int)arm.outputs().faults.fault[0].index : 0;
  std::printf("%-5s seed %d cable %2zu: f %d st %d moved %.2f deg c %.1fN | left %d enabled %.1fs st %d err %.2f joff %.2f c %.1f max %.0fN | %s %.0fs pts %zu fault %d@%d off %.2f deg contact %.1fN max %.0fN tip_u %.2f\n",
              when, seed, cable + 1, f1, state1, moved, l1.contact_N, left, t, (int)arm.outputs().state, err0, joff, l2.contact_N, l2.max_motor_N,
              out ? "OUT" : "no", retract_s, left_points, f2, i2, maxoff, contact, maxN, u);
  std::fflush(stdout);
}

void run(const char* physics, int seed, int only) {
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const double shares[] = {0.4 + 0.5 * unit(), 0.2 + 0.6 * unit()};
  ArmUnderControl arm({physics, static_cast<std::uint64_t>(seed), true, "prepare"});
  arm.boot();
  Pose from = arm.outputs().tip_command;
  const Vec3 node_from_m = arm.outputs().node_command_m[2];
  for (const closed_loop::Leg& leg : closed_loop::slit_legs()) {
    const int moment = leg.name == "segment 5 into the slit" ? 0 : leg.name == "to the rod" ? 1 : -1;
    double left_s = moment >= 0 ? leg.seconds * shares[moment] : -1.0;
    if (leg.name == "to the mouth") path.clear();
    int n = 0;
    arm.follow(
        leg.seconds, [&](double share) { return closed_loop::leg_setpoint(leg, from, node_from_m, share); },
        [&](ArmUnderControl& now) {
          if (++n % 5 == 0) path.push_back(now.outputs().theta_command_rad);
          if (left_s < 0.0) return;
          left_s -= now.table().tick_s;
          if (left_s >= 0.0) return;
          for (std::size_t c = 0; c < 15; ++c) {
            if (only >= 0 && (int)c != only) continue;
            std::fflush(stdout);
            if (fork() == 0) { lead_out(now, c, moment ? "rod" : "seg5", seed); _exit(0); }
            if (c % 2 == 1 || only >= 0) { wait(nullptr); wait(nullptr); }
          }
          while (wait(nullptr) > 0) {}
          if (moment == 1) std::exit(0);
        });
    from = leg.goal_in_base;
  }
}
}  // namespace
}  // namespace liana::numbers
int main(int argc, char** argv) { liana::numbers::run(argv[1], std::atoi(argv[2]), argc > 3 ? std::atoi(argv[3]) : -1); }
