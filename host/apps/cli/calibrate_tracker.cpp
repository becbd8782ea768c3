#include "host/apps/cli/calibrate_tracker.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "firmware_like/math/trig.hpp"
#include "host/apps/cli/fields_report.hpp"
#include "host/apps/cli/run_choice.hpp"
#include "host/apps/cli/still_poses.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/drives/calibration/calibration.hpp"

namespace liana::cli {
namespace {

using calibration::TrackerError, calibration::TrackerResult;

double max_zero_m(const TrackerResult& found) {
  double most_m = 0.0;
  for (const double zero_m : found.zero_m) most_m = std::max(most_m, std::fabs(zero_m));
  return most_m;
}

Json json_of(const TrackerError& error) { return {{"tip_m", error.tip_m}, {"tip_deg", error.tip_rad / kDegree}}; }

void show(const TrackerResult& found, std::size_t poses, const config::RobotConfig& robot, bool as_json) {
  if (as_json) {
    Json report = fields_json(found);
    report["poses"] = poses;
    report["max_zero_m"] = max_zero_m(found);
    report["before"] = json_of(found.before);
    report["after"] = json_of(found.after);
    std::printf("%s\n", report.dump().c_str());
    return;
  }
  print_fields(found, robot.table);
  std::printf("zeros of the cables: corrected by up to %.3f mm\n", 1e3 * max_zero_m(found));
  std::printf(
      "tip beside the tracker in %zu poses, rms: %.2f mm and %.3f deg with the table, %.2f mm and %.3f deg as found\n",
      poses, 1e3 * found.before.tip_m, found.before.tip_rad / kDegree, 1e3 * found.after.tip_m,
      found.after.tip_rad / kDegree);
  print_problems(found);
}

}  // namespace

int calibrate_by_tracker(const CalibrateOptions& options, const config::RobotConfig& robot) {
  const std::string folder = archive_folder("--run", options.run);
  return launcher::checked([&] {
    calibration::Calibration whole =
        calibration::load_calibration(options.calibration, robot, calibration::today_utc());
    const Stays run = stays_of(folder, robot);
    const std::vector<calibration::TrackedPose> tracked = calibration::read_tracker(options.tracker);
    std::vector<calibration::StillPose> poses;
    TrackerResult found;
    try {
      poses = still_poses(run, tracked);
      found = calibration::tracker_fit(robot.table, whole.fields, poses);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(options.tracker + ", run " + folder + ": " + error.what());
    }
    show(found, poses.size(), robot, options.json);
    if (!found.problems.empty()) return launcher::kExitFailure;
    whole.fields = calibration::merged(calibration::table_fields(robot.table), whole.fields, found.values);
    calibration::shift_zeros(found.zero_m, robot, whole);
    if (!options.out_file.empty()) launcher::write_output(options.out_file, calibration::calibration_json(whole));
    return launcher::kExitOk;
  });
}

}  // namespace liana::cli
