// recover [--count SEEDS] [--json]: an arm that loses a cable in the slit, led out on the cables that are left: the
// real core against the bench's arm, by the truth. A seed's arm goes its way once; at two moments that the seed draws,
// in segment 5's and in segment 4's way through the slit, every cable breaks in a copy of the whole process.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <thread>

#include "options.hpp"
#include "tests/closed_loop/fixture.hpp"
#include "tests/closed_loop/lead_out.hpp"
#include "tests/closed_loop/slit_path.hpp"

namespace liana::numbers {
namespace {

using closed_loop::ArmUnderControl;
using closed_loop::LeadOut;

struct Trial {
  std::int32_t seed;
  const char* moment;
  std::size_t cable;
};

// True where no part of the arm is in the slit any more: the tip is before its mouth.
bool is_out(ArmUnderControl& arm) {
  const config::SceneSlit& slit = *closed_loop::scene().slit;
  return dot(slit.u_axis, arm.plant().tip_in_base().position_m) < slit.mouth_u_m;
}

void print(const Trial& trial, const LeadOut& way, bool out, bool json) {
  const char* form =
      json ? "{\"seed\": %d, \"moment\": \"%s\", \"cable\": %zu, \"out\": %d, \"back\": %d, \"fault\": %d, "
             "\"points_left\": %zu, \"enable_s\": %.1f, \"seconds\": %.0f, \"contact_N\": %.2f, \"max_N\": %.0f, "
             "\"off_deg\": %.2f}\n"
           : "seed %d %-9s cable %2zu: out %d, back %d, fault %d, %zu points left, enabled in %.1f s, %.0f s, contact "
             "%.2f N, at most %.0f N, off %.2f deg\n";
  std::printf(form, trial.seed, trial.moment, trial.cable + 1, out ? 1 : 0, way.is_back ? 1 : 0, way.fault,
              way.points_left, way.enable_s, way.seconds, way.contact_N, way.max_motor_N, way.off_deg);
  std::fflush(stdout);
}

void collect(std::size_t& running, std::size_t down_to) {
  for (; running > down_to; --running) {
    int status = 0;
    if (wait(&status) < 0 || status != 0) std::exit(1);
  }
}

void try_all(ArmUnderControl& arm, std::int32_t seed, const char* moment, const closed_loop::Path& path, bool json) {
  const std::size_t together = std::max(1u, std::thread::hardware_concurrency());
  std::size_t running = 0;
  for (std::size_t cable = 0; cable < static_cast<std::size_t>(arm.table().cable_count()); ++cable) {
    std::fflush(stdout);
    const pid_t copy = fork();
    if (copy < 0) std::exit(1);
    if (copy == 0) {
      const LeadOut way = closed_loop::break_and_lead_out(arm, cable, path);
      print({seed, moment, cable}, way, is_out(arm), json);
      _exit(0);
    }
    collect(++running, together - 1);
  }
  collect(running, 0);
}

void run(std::int32_t seed, bool json) {
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  const double shares[] = {0.4 + 0.5 * unit(), 0.2 + 0.6 * unit()};
  ArmUnderControl arm({"nominal", static_cast<std::uint64_t>(seed), true, "prepare"});
  arm.boot();
  Pose from = arm.outputs().tip_command;
  const Vec3 node_from_m = arm.outputs().node_command_m[2];
  closed_loop::Path path;
  std::int32_t tick = 0;
  for (const closed_loop::Leg& leg : closed_loop::slit_legs()) {
    const bool is_first = leg.name == "segment 5 into the slit", is_second = leg.name == "to the rod";
    double left_s = is_first ? leg.seconds * shares[0] : is_second ? leg.seconds * shares[1] : -1.0;
    if (leg.name == "before the mouth") path.clear();  // the way back ends in the open
    arm.follow(
        leg.seconds, [&](double share) { return closed_loop::leg_setpoint(leg, from, node_from_m, share); },
        [&](ArmUnderControl& now) {
          if (++tick % now.table().interval_ticks == 0) path.push_back(now.outputs().theta_command_rad);
          if (left_s < 0.0) return;
          left_s -= now.table().tick_s;
          if (left_s < 0.0) try_all(now, seed, is_first ? "segment 5" : "rod", path, json);
        });
    if (is_second) return;
    from = leg.goal_in_base;
  }
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  const liana::numbers::Options options = liana::numbers::parse_options(argc, argv, 2);
  for (std::int32_t seed = 1; seed <= options.count; ++seed) liana::numbers::run(7330 + seed, options.json);
}
