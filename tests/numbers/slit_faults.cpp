// slit_faults [--only KIND] SEED...: what a fault of one cable does while the arm is in the slit: the real core against
// the bench's arm, by the truth. A seed's arm goes its way once; at moments that the seed draws, in segment 5's and in
// segment 4's way through the slit, every cable gets every fault in a copy of the whole process.
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
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
using closed_loop::Plant;

constexpr int kAfter = 1250;         // ticks watched: 5 s
constexpr double kRest_m_s = 0.005;  // a node that is no faster rests

// One kind of fault: what happens in tick `age` (0 = the first).
struct Kind {
  const char* name;
  void (*act)(Plant& plant, std::size_t cable, int age);
};

void part(Plant& plant, std::size_t cable, int age) {
  if (age == 0) plant.loosen(cable, 1.0);
}
void slip(Plant& plant, std::size_t cable, int age) {
  if (age == 0) plant.loosen(cable, 0.5e-3);
}
template <int ticks>
void lose(Plant& plant, std::size_t cable, int age) {
  if (age == 0) plant.lose_reading(cable);
  if (age == ticks) plant.find_reading(cable);
}

void nothing(Plant&, std::size_t, int) {}

constexpr Kind kKinds[] = {{"break", part},
                           {"reading gone for 1 tick", lose<1>},
                           {"reading gone for 2 ticks", lose<2>},
                           {"reading gone for 10 ticks", lose<10>},
                           {"reading gone for 25 ticks", lose<25>},
                           {"reading gone", lose<99999>},
                           {"slip 0.5 mm", slip}};

// What came of one fault.
struct Result {
  int fault = 0;           // first
  int ticks = 0;           // until it was latched
  double contact_N = 0.0;  // largest
  double contact_s = 0.0;  // when
  double min_clearance_m = 1e3;
  double half_second_mm = 0.0, largest_mm = 0.0;  // how far a node was from where the sound arm was
  double rest_s = 0.0;                            // last time any node was faster than kRest_m_s
  int state = 0;
};

using Nodes = std::vector<Vec3>;
Nodes nodes_of(ArmUnderControl& arm) {
  const cable::ArmKinematics at = cable::forward_kinematics(arm.table(), arm.plant().theta_rad());
  Nodes nodes;
  for (std::int32_t m = 1; m <= arm.table().segment_count; ++m)
    nodes.push_back(at.node_in_base[static_cast<std::size_t>(m)].position_m);
  return nodes;
}
double farthest_mm(const Nodes& a, const Nodes& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, closed_loop::distance_mm(a[i], b[i]));
  return most;
}

// Where the sound arm went, tick by tick: its copy's.
struct Way {
  double node_m[kAfter][8][3];
};

Result watch(ArmUnderControl& arm, const Kind& kind, std::size_t cable, Way* sound, bool tensions_valid) {
  Result result;
  arm.plant().take_load();
  Nodes before = nodes_of(arm);
  for (int age = 0; age < kAfter; ++age) {
    kind.act(arm.plant(), cable, age);
    arm.step();
    const double now_s = (age + 1) * arm.table().tick_s;
    const double contact_N = arm.plant().take_load().contact_N;
    if (contact_N > result.contact_N) result.contact_N = contact_N, result.contact_s = now_s;
    result.min_clearance_m = std::min(result.min_clearance_m, arm.plant().slit_clearance_m());
    const Nodes nodes = nodes_of(arm);
    Nodes from = nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      for (std::size_t i = 0; i < 3; ++i) {
        double& sound_m = sound->node_m[age][n][i];
        if (tensions_valid) sound_m = nodes[n][i];
        from[n][i] = sound_m;
      }
    }
    result.largest_mm = std::max(result.largest_mm, farthest_mm(nodes, from));
    if (now_s <= 0.5) result.half_second_mm = result.largest_mm;
    if (farthest_mm(nodes, before) / 1000.0 / arm.table().tick_s > kRest_m_s) result.rest_s = now_s;
    before = nodes;
    if (result.fault == 0 && arm.outputs().faults.count > 0) {
      result.fault = static_cast<int>(arm.outputs().faults.fault[0].number);
      result.ticks = age;
    }
  }
  result.state = static_cast<int>(arm.outputs().state);
  return result;
}

// Every fault of every cable, each in a copy of this process.
void try_all(ArmUnderControl& arm, int seed, double at_s, const char* only) {
  void* const shared = mmap(nullptr, sizeof(Way), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) std::exit(1);
  Way* const sound = static_cast<Way*>(shared);
  if (fork() == 0) {
    watch(arm, {"sound", nothing}, 0, sound, true);
    _exit(0);
  }
  wait(nullptr);
  for (const Kind& kind : kKinds) {
    if (only != nullptr && std::string(kind.name) != only) continue;
    for (std::size_t cable = 0; cable < static_cast<std::size_t>(arm.table().cable_count()); ++cable) {
      std::fflush(stdout);
      const pid_t copy = fork();
      if (copy == 0) {
        const Result r = watch(arm, kind, cable, sound, false);
        std::printf(
            "%-26s seed %3d at %6.1f s cable %2zu: %d after %d, contact %5.2f N @ %.2f, clear %5.1f mm, moved "
            "%5.1f / %5.1f mm, rest %.2f s, state %d\n",
            kind.name, seed, at_s, cable, r.fault, r.ticks, r.contact_N, r.contact_s, 1000.0 * r.min_clearance_m,
            r.half_second_mm, r.largest_mm, r.rest_s, r.state);
        std::fflush(stdout);
        _exit(0);
      }
      int status = 0;
      if (copy < 0 || waitpid(copy, &status, 0) != copy || status != 0) std::exit(1);
    }
  }
}

// Moments: one in the second half of segment 5's way into the slit, one in segment 4's.
void run(int seed, const char* only) {
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const double shares[] = {0.4 + 0.5 * unit(), 0.2 + 0.6 * unit()};
  ArmUnderControl arm({"nominal", static_cast<std::uint64_t>(seed), true, "prepare"});
  arm.boot();
  Pose from = arm.outputs().tip_command;
  const Vec3 node_from_m = arm.outputs().node_command_m[2];
  double now_s = 0.0;
  for (const closed_loop::Leg& leg : closed_loop::slit_legs()) {
    const int moment = leg.name == "segment 5 into the slit" ? 0 : leg.name == "to the rod" ? 1 : -1;
    double left_s = moment >= 0 ? leg.seconds * shares[moment] : -1.0;
    arm.follow(
        leg.seconds, [&](double share) { return closed_loop::leg_setpoint(leg, from, node_from_m, share); },
        [&](ArmUnderControl& now) {
          now_s += now.table().tick_s;
          if (left_s < 0.0) return;
          left_s -= now.table().tick_s;
          if (left_s < 0.0) try_all(now, seed, now_s, only);
        });
    from = leg.goal_in_base;
  }
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  const bool chosen = argc > 2 && std::string(argv[1]) == "--only";
  for (int i = chosen ? 3 : 1; i < argc; ++i) liana::numbers::run(std::atoi(argv[i]), chosen ? argv[2] : nullptr);
}
