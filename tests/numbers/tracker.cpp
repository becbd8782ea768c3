// How lab_1g stands in four mountings before and after its geometry was found with a tracker: arms that seeds build,
// module lengths and hole radius off by 1 % at most, with all else that the bench draws; poses that no fit has
// seen.
#include <algorithm>
#include <cstdio>

#include "tests/closed_loop/load_rig.hpp"
#include "tests/numbers/options.hpp"

using namespace liana;

namespace {

constexpr double kGeometryShare = 0.01;
constexpr std::size_t kPoses = 14, kGoals = 5;

void print(const char* name, std::vector<double> tip_m) {
  std::sort(tip_m.begin(), tip_m.end());
  const auto at = [&](double share) { return 1e3 * tip_m[static_cast<std::size_t>(share * double(tip_m.size() - 1))]; };
  std::printf("  %-7s tip error mm: median %.2f p90 %.2f worst %.2f\n", name, at(0.5), at(0.9), at(1.0));
}

}  // namespace

int main(int argc, char** argv) {
  const numbers::Options options = numbers::parse_options(argc, argv, 20);
  for (const closed_loop::LabMounting& mounting : closed_loop::kLabMountings) {
    const cable::RobotParams table = closed_loop::lab_table(mounting.gravity_m_s2);
    std::vector<double> before_m, after_m;
    for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(options.count); ++seed) {
      const auto goals = closed_loop::drawn_poses(table, seed, kGoals);
      const calibration::TrackerResult found = closed_loop::find_geometry(
          mounting, seed, kGeometryShare, closed_loop::drawn_poses(table, seed + 1000, kPoses));
      const auto gather = [&](std::vector<double>& all, const cable::RobotParams& used,
                              const cable::CableVector& zero_m) {
        const auto more = closed_loop::standing(mounting, seed, used, goals, kGeometryShare, zero_m).tip_error_m;
        all.insert(all.end(), more.begin(), more.end());
      };
      gather(before_m, table, {});
      gather(after_m, closed_loop::with(table, found), found.zero_m);
      for (const std::string& problem : found.problems) std::printf("  arm %d: %s\n", int(seed), problem.c_str());
    }
    std::printf("%s, %d arms\n", mounting.name, options.count);
    print("before", before_m);
    print("after", after_m);
    std::fflush(stdout);
  }
}
