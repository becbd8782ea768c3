// A payload pushed into its adapter, `--count` times with another payload, base, adapter, friction and sensor each: the
// real Controller against the bench's arm, without a bus. Seeds that no test has and nothing was tuned on.
#include <cstdio>

#include "tests/numbers/options.hpp"
#include "tests/serial/push_run.hpp"

namespace liana::numbers {
namespace {

constexpr std::uint64_t kFirstSeed = 160001;
constexpr double kMost_s = 40.0;  // as the mission allows

void print(std::uint64_t seed, const test::PushRun& run, bool json) {
  const char* form =
      json ? "{\"seed\": %d, \"captured_s\": %.3f, \"peak_N\": %.2f, \"peak_Nm\": %.2f, \"base_m\": %.5f, "
             "\"after_1s_N\": %.2f, \"loaded_s\": %.3f, \"unload_ticks\": %d, \"faults\": %d}\n"
           : "seed %d: captured %.3f s, %.2f N, %.2f N m, base %.5f m, after 1 s %.2f N, loaded %.3f s, "
             "%d ticks, %d faults\n";
  std::printf(form, static_cast<int>(seed), run.captured_s, run.peak_N, run.peak_Nm, run.base_m, run.after_1s_N,
              run.loaded_s, run.unload_ticks, static_cast<int>(run.faults));
}

}  // namespace
}  // namespace liana::numbers

int main(int argc, char** argv) {
  using namespace liana;
  const numbers::Options options = numbers::parse_options(argc, argv, 500);
  for (std::int32_t i = 0; i < options.count; ++i) {
    const std::uint64_t seed = numbers::kFirstSeed + static_cast<std::uint64_t>(i);
    test::ForceRig rig(test::drawn_case(seed));
    numbers::print(seed, test::run_push(rig, serial::PushLaw::kForce, numbers::kMost_s), options.json);
    std::fflush(stdout);
  }
}
