// A payload pushed into its adapter, `--count` times with another payload, base, adapter, friction and sensor each: the
// real Controller against the bench's arm, without a bus. As a servo leaves it, and a fifth as often misaligned by up
// to as much as the funnels take. Seeds that no test has and nothing was tuned on.
#include <algorithm>
#include <cstdio>

#include "tests/numbers/options.hpp"
#include "tests/serial/push_run.hpp"

namespace liana::numbers {
namespace {

constexpr std::uint64_t kFirstSeed = 191001;
constexpr double kMost_s = 40.0;  // as the mission allows

constexpr double kDeg = 3.14159265358979 / 180.0;

constexpr test::Misalignment kAsServoed{0.0014, 0.5 * kDeg};  // drawn_case: so far in x and so far in y

// Beginnings that are judged one by one: to 28 mm of the 30 that the funnels are wide, and as far turned as the mission
// lets a push turn the payload back.
constexpr test::Misalignment kMisaligned[] = {
    {0.010, 0.5 * kDeg}, {0.020, 0.5 * kDeg}, {0.028, 0.5 * kDeg}, {0.010, 1.0 * kDeg}, {0.010, 2.0 * kDeg}};

void print(std::uint64_t seed, const test::Misalignment& most, const test::ForceCase& drawn, bool json) {
  test::ForceRig rig(drawn);
  const test::PushRun run = test::run_push(rig, serial::InsertLaw::kForce, kMost_s);
  const char* form =
      json ? "{\"seed\": %d, \"most_aside_mm\": %.1f, \"most_tilt_deg\": %.1f, \"captured_s\": %.3f, "
             "\"peak_N\": %.2f, \"peak_Nm\": %.2f, \"base_m\": %.5f, \"after_1s_N\": %.2f, "
             "\"loaded_s\": %.3f, \"unload_ticks\": %d, \"resisted_N\": %.2f, \"end\": %d, \"faults\": %d}\n"
           : "seed %d, to %.1f mm and %.1f deg: captured %.3f s, %.2f N, %.2f N m, base %.5f m, after 1 s "
             "%.2f N, loaded %.3f s, %d ticks, overcame %.2f N, end %d, %d faults\n";
  std::printf(form, static_cast<int>(seed), 1e3 * most.aside_m, most.tilt_rad / kDeg, run.captured_s, run.peak_N,
              run.peak_Nm, run.base_m, run.after_1s_N, run.loaded_s, run.unload_ticks, run.resisted_N,
              static_cast<int>(run.end), static_cast<int>(run.faults));
  std::fflush(stdout);
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  using namespace liana;
  const numbers::Options options = numbers::parse_options(argc, argv, 500);
  std::uint64_t seed = numbers::kFirstSeed;
  for (std::int32_t i = 0; i < options.count; ++i, ++seed)
    numbers::print(seed, numbers::kAsServoed, test::drawn_case(seed), options.json);
  const std::int32_t fifth = std::max(1, options.count / 5);
  for (const test::Misalignment& most : numbers::kMisaligned)
    for (std::int32_t i = 0; i < fifth; ++i, ++seed)
      numbers::print(seed, most, test::misaligned_case(seed, most), options.json);
}
