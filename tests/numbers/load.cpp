// How lab_1g stands in three mountings before and after its load was found: arms that seeds build, poses that no fit
// has seen.
#include <algorithm>
#include <cstdio>
#include <iterator>

#include "tests/closed_loop/load_rig.hpp"
#include "tests/numbers/options.hpp"

using namespace liana;

namespace {

void gather(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

void print(const char* name, const closed_loop::Standing& all) {
  std::printf(
      "  %-7s tip error mm: median %.2f p90 %.2f worst %.2f; tension N: median %.2f worst %.2f; load N m: median "
      "%.3f worst %.3f\n",
      name, 1e3 * quantile(all.tip_error_m, 0.5), 1e3 * quantile(all.tip_error_m, 0.9),
      1e3 * quantile(all.tip_error_m, 1.0), quantile(all.tension_error_N, 0.5), quantile(all.tension_error_N, 1.0),
      quantile(all.load_error_Nm, 0.5), quantile(all.load_error_Nm, 1.0));
}

}  // namespace

int main(int argc, char** argv) {
  const numbers::Options options = numbers::parse_options(argc, argv, 20);
  for (const closed_loop::LabMounting& mounting : closed_loop::kLabMountings) {
    const cable::RobotParams table = closed_loop::lab_table(mounting.gravity_m_s2);
    const std::vector<calibration::LoadPose> poses = calibration::load_poses(table);
    closed_loop::Standing before, after;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(options.count); ++seed) {
      const auto goals = closed_loop::drawn_poses(table, seed, 3);
      const calibration::LoadResult found = closed_loop::find_load(mounting, seed, poses);
      for (const auto& [all, used] : {std::pair{&before, table}, {&after, closed_loop::with(table, found)}}) {
        const closed_loop::Standing one = closed_loop::standing(mounting, seed, used, goals);
        gather(all->tip_error_m, one.tip_error_m);
        gather(all->tension_error_N, one.tension_error_N);
        gather(all->load_error_Nm, one.load_error_Nm);
      }
    }
    std::printf("%s, %d arms\n", mounting.name, options.count);
    print("before", before);
    print("after", after);
    std::fflush(stdout);
  }
}
