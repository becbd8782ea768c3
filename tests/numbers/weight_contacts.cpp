// weight_contacts [--moves] SEED...: contacts of lab_1g in four mountings, built with the errors of each seed. Without
// --moves something pushes its body, a fifth of a newton a second more, until a fault says so; with it nothing does,
// and the arm moves for three minutes a seed: every fault is a false one. The real core against the bench's arm.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <random>
#include <vector>

#include "tests/closed_loop/arm_under_control.hpp"
#include "tests/closed_loop/fixture.hpp"

namespace liana::numbers {
namespace {

using closed_loop::ArmUnderControl;

constexpr double kMoves_s = 180.0, kRise_N_s = 0.2, kMax_N = 30.0, kLeg_s = 9.0;

struct Told {
  int fault = 0;
  double force_N = 0.0, after_s = 0.0;
};

// Moves between poses that the seed draws, `push_N` (from the time) at a link, until a fault or the end.
template <class Push>
Told move(const closed_loop::LabMounting& mounting, int seed, double seconds, Push push) {
  std::mt19937 random(static_cast<unsigned>(seed));
  ArmUnderControl arm({"nominal", static_cast<std::uint64_t>(seed), true, "park", CLOSED_LOOP_DATA "/lab_1g.json",
                       mounting.gravity_m_s2},
                      closed_loop::lab_table(mounting.gravity_m_s2));
  arm.boot();
  const char* const poses[] = {"look", "deep", "zero", "park"};
  Told told;
  double now_s = 0.0;
  while (told.fault == 0 && now_s < seconds) {
    arm.move_joints(closed_loop::lab_pose_rad(poses[random() % 4]), kLeg_s, [&](ArmUnderControl& now) {
      now_s += now.table().tick_s;
      const double force_N = push(now, now_s);
      if (told.fault == 0 && now.outputs().faults.count > 0)
        told = {static_cast<int>(now.outputs().faults.fault[0].number), force_N, now_s};
    });
  }
  return told;
}

void moves(const closed_loop::LabMounting& mounting, const std::vector<int>& seeds) {
  int faults = 0, contacts = 0;
  double moved_s = 0.0;
  for (const int seed : seeds) {
    const Told told = move(mounting, seed, kMoves_s, [](ArmUnderControl&, double) { return 0.0; });
    moved_s += told.fault == 0 ? kMoves_s : told.after_s;
    if (told.fault != 0)
      std::printf("%-12s seed %d: fault %d after %.1f s\n", mounting.name, seed, told.fault, told.after_s);
    faults += told.fault != 0 ? 1 : 0;
    contacts += told.fault == 5008 ? 1 : 0;
  }
  std::printf("%-12s moved %.2f h: %d contacts, %d other faults\n", mounting.name, moved_s / 3600.0, contacts,
              faults - contacts);
  std::fflush(stdout);
}

void pushes(const closed_loop::LabMounting& mounting, const std::vector<int>& seeds) {
  for (std::size_t segment = 0; segment < 3; ++segment) {
    std::vector<double> told_N;
    int other = 0;
    for (const int seed : seeds) {
      std::mt19937 random(static_cast<unsigned>(seed));
      const std::size_t link = 5 * segment + 2 + random() % 3;
      const double way_rad = 2.0 * std::numbers::pi * static_cast<double>(random()) / 4294967296.0;
      const Vec3 across{0.0, std::cos(way_rad), std::sin(way_rad)};
      const Told told = move(mounting, seed, 10.0 + kMax_N / kRise_N_s, [&](ArmUnderControl& now, double now_s) {
        const double force_N = std::max(0.0, kRise_N_s * (now_s - 10.0));
        now.plant().push(link, scale(across, force_N));
        return force_N;
      });
      told_N.push_back(told.fault == 0 ? kMax_N : told.force_N);
      other += told.fault != 5008 ? 1 : 0;
    }
    std::sort(told_N.begin(), told_N.end());
    std::printf("%-12s segment %zu: told from %.1f N, half by %.1f N, all by %.1f N; %d by another fault or not\n",
                mounting.name, segment + 1, told_N.front(), told_N[told_N.size() / 2], told_N.back(), other);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  using namespace liana::numbers;
  const bool only_moves = argc > 1 && std::strcmp(argv[1], "--moves") == 0;
  std::vector<int> seeds;
  for (int i = only_moves ? 2 : 1; i < argc; ++i) seeds.push_back(std::atoi(argv[i]));
  for (const liana::closed_loop::LabMounting& mounting : liana::closed_loop::kLabMountings)
    only_moves ? moves(mounting, seeds) : pushes(mounting, seeds);
}
