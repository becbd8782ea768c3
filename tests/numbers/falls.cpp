// falls [--each | --only KIND] SEED...: how far lab_1g falls after a fault, in four mountings: the real core against
// the bench's arm, built with the errors of its seed, by the truth. A seed's arm goes its tour once in each mounting;
// at a moment that the seed draws, every cable and drive gets every fault in a copy of the whole process.
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#include "tests/closed_loop/arm_under_control.hpp"
#include "tests/closed_loop/fixture.hpp"

namespace liana::numbers {
namespace {

using closed_loop::ArmUnderControl;

constexpr double kAfter_s = 3.0;  // watched

struct Kind {
  const char* name;
  void (*begin)(ArmUnderControl& arm, std::size_t cable);
};
constexpr Kind kKinds[] = {
    {"break", [](ArmUnderControl& arm, std::size_t cable) { arm.plant().loosen(cable, 1.0); }},
    {"slip 0.5 mm", [](ArmUnderControl& arm, std::size_t cable) { arm.plant().loosen(cable, 0.5e-3); }},
    {"slip 3 mm", [](ArmUnderControl& arm, std::size_t cable) { arm.plant().loosen(cable, 3e-3); }},
    {"reading lost", [](ArmUnderControl& arm, std::size_t cable) { arm.plant().lose_reading(cable); }},
    {"drive lost", [](ArmUnderControl& arm, std::size_t cable) { arm.lose_drive(cable); }},
    {"stop", [](ArmUnderControl& arm, std::size_t) { arm.ask(Request::kStop); }},
    {"disable", [](ArmUnderControl& arm, std::size_t) { arm.ask(Request::kDisable); }}};

// What came of one fault; of several the worst.
struct Result {
  double fall_mm = 0.0;   // of the tip, along gravity, from where it was
  double moved_mm = 0.0;  // any way
  double max_N = 0.0;     // at a motor
  int cable = 0;
  int fault = 0;  // first
  int state = 0;  // in which it ended
};

Result watch(ArmUnderControl& arm, const Kind& kind, std::size_t cable) {
  Result result;
  result.cable = static_cast<int>(cable) + 1;
  const Vec3 from_m = arm.plant().tip_in_base().position_m;
  const Vec3 down = scale(arm.table().gravity_m_s2, 1.0 / closed_loop::kEarth_m_s2);
  arm.plant().take_load();
  kind.begin(arm, cable);
  for (double now_s = 0.0; now_s < kAfter_s; now_s += arm.table().tick_s) {
    arm.step();
    const Vec3 way_m = subtract(arm.plant().tip_in_base().position_m, from_m);
    result.fall_mm = std::max(result.fall_mm, 1000.0 * dot(way_m, down));
    result.moved_mm = std::max(result.moved_mm, 1000.0 * norm(way_m));
    if (result.fault == 0 && arm.outputs().faults.count > 0)
      result.fault = static_cast<int>(arm.outputs().faults.fault[0].number);
  }
  result.max_N = arm.plant().take_load().max_motor_N;
  result.state = static_cast<int>(arm.outputs().state);
  return result;
}

Result in_a_copy(ArmUnderControl& arm, const Kind& kind, std::size_t cable) {
  static Result* const shared =
      static_cast<Result*>(mmap(nullptr, sizeof(Result), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  std::fflush(stdout);
  const pid_t copy = fork();
  if (copy == 0) {
    *shared = watch(arm, kind, cable);
    _exit(0);
  }
  int status = 0;
  if (copy < 0 || waitpid(copy, &status, 0) != copy || status != 0) std::exit(1);
  return *shared;
}

void print(const char* mounting, const char* kind, int over, int cases, const Result& r) {
  std::printf(
      "%-12s %-14s fall %6.1f mm, moved %6.1f mm, %5.1f N, cable %d, fault %d, state %d; over 100 mm %d of %d\n",
      mounting, kind, r.fall_mm, r.moved_mm, r.max_N, r.cable, r.fault, r.state, over, cases);
}

struct Options {
  bool each = false;           // print every one
  const char* only = nullptr;  // kind
};

struct Worst {
  Result result;
  int over = 0, cases = 0;
};

void try_all(ArmUnderControl& arm, const closed_loop::LabMounting& mounting, const Options& options,
             Worst (&worst)[std::size(kKinds)]) {
  for (std::size_t k = 0; k < std::size(kKinds); ++k) {
    if (options.only != nullptr && std::strcmp(options.only, kKinds[k].name) != 0) continue;
    const bool of_a_cable = k + 2 < std::size(kKinds);
    const auto cables = of_a_cable ? static_cast<std::size_t>(arm.table().cable_count()) : 1;
    for (std::size_t cable = 0; cable < cables; ++cable) {
      const Result r = in_a_copy(arm, kKinds[k], cable);
      if (options.each) print(mounting.name, kKinds[k].name, r.fall_mm > 100.0 ? 1 : 0, 1, r);
      ++worst[k].cases;
      if (r.fall_mm > 100.0) ++worst[k].over;
      if (r.fall_mm >= worst[k].result.fall_mm) worst[k].result = r;
    }
  }
}

void run(const closed_loop::LabMounting& mounting, int seed, const Options& options,
         Worst (&worst)[std::size(kKinds)]) {
  std::mt19937 random(static_cast<unsigned>(seed));
  constexpr double kLeg_s = 8.0;
  const char* const legs[] = {"look", "zero", "deep", "park"};
  double left_s = kLeg_s * static_cast<double>(std::size(legs)) * static_cast<double>(random()) / 4294967296.0;
  ArmUnderControl arm({"nominal", static_cast<std::uint64_t>(seed), true, "park", CLOSED_LOOP_DATA "/lab_1g.json",
                       mounting.gravity_m_s2},
                      closed_loop::lab_table(mounting.gravity_m_s2));
  arm.boot();
  for (const char* const leg : legs) {
    arm.move_joints(closed_loop::lab_pose_rad(leg), kLeg_s, [&](ArmUnderControl& now) {
      if (left_s < 0.0) return;
      left_s -= now.table().tick_s;
      if (left_s < 0.0) try_all(now, mounting, options, worst);
    });
    if (left_s < 0.0) break;
  }
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  using namespace liana::numbers;
  const bool each = argc > 1 && std::strcmp(argv[1], "--each") == 0;
  const bool chosen = argc > 2 && std::strcmp(argv[1], "--only") == 0;
  const Options options{each, chosen ? argv[2] : nullptr};
  for (const liana::closed_loop::LabMounting& mounting : liana::closed_loop::kLabMountings) {
    Worst worst[std::size(kKinds)]{};
    for (int i = chosen ? 3 : each ? 2 : 1; i < argc; ++i) run(mounting, std::atoi(argv[i]), options, worst);
    for (std::size_t k = 0; k < std::size(kKinds); ++k)
      if (worst[k].cases > 0) print(mounting.name, kKinds[k].name, worst[k].over, worst[k].cases, worst[k].result);
  }
}
