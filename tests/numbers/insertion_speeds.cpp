// How quick a push may be, and what it leaves of the base: the same cases with slower and slower ways in (K_D along the
// axis), on the soft base and on one 20 times as stiff, and a wall that a payload of a ton meets beside the hole.
// One JSON object a line; `--svg FILE` draws one push on both bases.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <vector>

#include "tests/numbers/push_picture.hpp"
#include "tests/serial/push_run.hpp"

namespace liana::numbers {
namespace {

constexpr double kDampings_Ns_m[] = {1600.0, 2400.0, 3200.0, 4200.0, 6000.0, 8000.0};
constexpr double kSoft = 1.0, kStiff = 20.0;  // share of the base's stiffness
constexpr std::uint64_t kFirstSeed = 197001;
constexpr int kSeeds = 8;
constexpr double kMost_s = 40.0;     // as the mission allows
constexpr double kAfter_s = 30.0;    // that the base is watched after a capture
constexpr double kAside_m = 0.0045;  // of a pin that misses its hole, whose clearance is 3 mm at the face

// The base from where it began, largest less least over `seconds` up to `until`, halved.
double swing_m(const std::vector<Instant>& course, double from_s, double until_s) {
  double least = 1e9, most = -1e9;
  for (const Instant& now : course) {
    if (now.time_s < from_s || now.time_s > until_s) continue;
    least = std::min(least, now.base_m);
    most = std::max(most, now.base_m);
  }
  return most < least ? 0.0 : 0.5 * (most - least);
}

// Until kAfter_s after the capture, or kMost_s where there is none.
std::vector<Instant> push_of(const test::ForceCase& drawn, double damping_Ns_m) {
  test::ForceRig rig(drawn);
  rig.enable();
  serial::Setpoint push = rig.push(30.0);
  push.push.gains[serial::kAxialDamping] = damping_Ns_m;
  rig.ask(push);
  std::vector<Instant> course;
  const double began_s = rig.time_s();
  double end_s = kMost_s;
  while (rig.time_s() - began_s < end_s) {
    const serial::Outputs& out = rig.tick();
    const bench::Vec3 contact_N = rig.contact().force_N;
    const bool captured = out.push.end == serial::InsertResult::kCaptured;
    course.push_back({rig.time_s() - began_s, out.push.set_N, rig.axial_N(), bench::norm(contact_N), rig.base_moved_m(),
                      rig.plate().pose.position_m.z, captured});
    if (captured && end_s == kMost_s) end_s = course.back().time_s + kAfter_s;
  }
  return course;
}

double captured_s(const std::vector<Instant>& course) {
  const auto found = std::find_if(course.begin(), course.end(), [](const Instant& now) { return now.captured; });
  return found == course.end() ? -1.0 : found->time_s;
}

double hardest_N(const std::vector<Instant>& course) {
  double most = 0.0;
  for (const Instant& now : course) most = std::max(most, now.contact_N);
  return most;
}

// The hardest blow of a ton that misses its holes by as much in four directions, against the stiffest walls.
double wall_N(double base_share, double damping_Ns_m) {
  double most = 0.0;
  for (int quarter = 0; quarter < 4; ++quarter) {
    test::ForceCase worst;
    worst.payload_kg = 1000.0;
    worst.adapter.stiffness_N_m = 2e5;
    worst.base_share = base_share;
    worst.tilt_rad = {};
    worst.aside_m = {kAside_m * std::cos(1.5708 * quarter), kAside_m * std::sin(1.5708 * quarter), 0.0};
    worst.before_m = 0.005;
    most = std::max(most, hardest_N(push_of(worst, damping_Ns_m)));
  }
  return most;
}

void print(double base_share, double damping_Ns_m) {
  for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
    test::ForceCase drawn = test::drawn_case(seed);
    drawn.base_share *= base_share;
    const std::vector<Instant> course = push_of(drawn, damping_Ns_m);
    const double at_s = captured_s(course);
    std::printf(
        "{\"base_share\": %g, \"damping_Ns_m\": %g, \"seed\": %d, \"captured_s\": %.3f, \"peak_N\": %.2f, "
        "\"swing_5s_m\": %.5f, \"swing_30s_m\": %.5f}\n",
        base_share, damping_Ns_m, static_cast<int>(seed), at_s, hardest_N(course),
        at_s < 0.0 ? 0.0 : swing_m(course, at_s, at_s + 5.0),
        at_s < 0.0 ? 0.0 : swing_m(course, at_s + 20.0, at_s + kAfter_s));
  }
  std::printf("{\"base_share\": %g, \"damping_Ns_m\": %g, \"wall_N\": %.2f}\n", base_share, damping_Ns_m,
              wall_N(base_share, damping_Ns_m));
  std::fflush(stdout);
}

bool draw(const char* file) {
  test::ForceCase soft, stiff;
  stiff.base_share = kStiff;
  const double damping_Ns_m = test::ForceRig(soft).robot().push_gains[serial::kAxialDamping];
  std::ofstream out(file);
  out << push_picture(push_of(soft, damping_Ns_m), push_of(stiff, damping_Ns_m)) << std::flush;
  if (!out) std::fprintf(stderr, "insertion_speeds: --svg: %s cannot be written\n", file);
  return bool(out);
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  using namespace liana::numbers;
  const bool draws = argc == 3 && std::strcmp(argv[1], "--svg") == 0;
  if (argc != 1 && !draws) {
    std::fprintf(stderr, "%s: bad option %s: allowed: --svg FILE\n", argv[0], argv[1]);
    return 2;
  }
  if (draws) return draw(argv[2]) ? 0 : 2;
  for (const double base_share : {kSoft, kStiff})
    for (const double damping_Ns_m : kDampings_Ns_m) print(base_share, damping_Ns_m);
}
