#include "host/apps/cli/still_poses.hpp"

#include <cmath>
#include <stdexcept>

#include "firmware_like/math/trig.hpp"
#include "host/api/telemetry/record.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/calibration/text.hpp"
#include "host/model/config/serial_robot.hpp"
#include "host/storage/archive/reader.hpp"
#include "host/storage/archive/stretches.hpp"

namespace liana::cli {
namespace {

constexpr int kSettle = 50, kReadings = 250, kMinReadings = 25;  // records of 20 ms: after it came to rest; averaged
constexpr double kMargin_s = 0.1;                                // at both ends, for what the clocks' offset is off by

const telemetry::Place& place_of(const telemetry::Layout& layout, const std::string& field) {
  for (const telemetry::Place& place : layout.places) {
    if (place.field.path == field) return place;
  }
  throw std::runtime_error("the run recorded no " + field + ": give a run of a cable arm");
}

// The stays as they come, record by record.
class Gatherer {
 public:
  Gatherer(const telemetry::Layout& layout)
      : theta_(place_of(layout, "measured_js_deg")),
        tension_(place_of(layout, "tension_N")),
        position_(place_of(layout, "drives.position_m")),
        tip_(place_of(layout, "measured_cp")) {}

  void take(const std::string& record, const Json& facts) {
    const double time_s = telemetry::header_of(record).time_s;
    const Vec3 tip_m{value(record, tip_, 0), value(record, tip_, 1), value(record, tip_, 2)};
    if (!std::isfinite(norm(tip_m))) return finish();
    out.tip.push_back({time_s, tip_m});
    if (facts.value("state", "") != "ENABLED" || !facts.value("at_rest", false)) return finish();
    if (++seen_ <= kSettle || seen_ > kSettle + kReadings) return;
    if (seen_ == kSettle + 1) now_.from_s = time_s;
    now_.to_s = time_s;
    add(record, theta_, kDegree, now_.pose.theta_rad);
    add(record, tension_, 1.0, now_.pose.tension_N);
    add(record, position_, 1.0, now_.pose.position_m);
  }

  void finish() {
    const int count = std::min(seen_ - kSettle, kReadings);
    if (count >= kMinReadings) {
      for (double& value : now_.pose.theta_rad) value /= count;
      for (double& value : now_.pose.tension_N) value /= count;
      for (double& value : now_.pose.position_m) value /= count;
      out.stays.push_back(now_);
    }
    now_ = {};
    seen_ = 0;
  }

  Stays out;

 private:
  static double value(const std::string& record, const telemetry::Place& place, std::size_t i) {
    return static_cast<double>(telemetry::value_of(record, place, i));
  }
  template <class Numbers>
  static void add(const std::string& record, const telemetry::Place& place, double unit, Numbers& sum) {
    for (std::size_t i = 0; i < std::min(place.count, sum.size()); ++i) sum[i] += unit * value(record, place, i);
  }

  const telemetry::Place &theta_, &tension_, &position_, &tip_;
  Stay now_;
  int seen_ = 0;  // records at rest
};

}  // namespace

Stays stays_of(const std::string& folder, const config::RobotConfig& robot) {
  const archive::Reader reader(folder);
  const archive::Life& life = reader.life();
  const std::string source = folder + ": robot";
  if (config::robot_kind(life.robot, source) == "serial" ||
      config::parse_robot(life.robot, source, "nominal", config::parse_buses(life.buses, folder + ": buses"))
              .canonical_json != robot.canonical_json)
    throw std::runtime_error(folder +
                             ": the run was made with another robot, or another version of its table: allowed " +
                             robot.name + " as it is now: name the run with --run, or the robot with --robot");
  if (!reader.layout()) throw std::runtime_error(folder + ": the run recorded no state: give another run");
  Gatherer gatherer(*reader.layout());
  archive::Stretches(reader, archive::kAll).visit([&](const std::string& record, const Json& facts) {
    gatherer.take(record, facts);
  });
  gatherer.finish();
  return gatherer.out;
}

std::vector<calibration::StillPose> still_poses(const Stays& run,
                                                const std::vector<calibration::TrackedPose>& tracked) {
  std::vector<calibration::StillPose> out;
  if (run.tip.size() < 2) throw std::runtime_error("the run has no states of an arm that is ready");
  const double offset_s = calibration::clock_offset_s(run.tip, tracked);
  for (const Stay& stay : run.stays) {
    const auto marker =
        calibration::mean_pose(tracked, stay.from_s + kMargin_s - offset_s, stay.to_s - kMargin_s - offset_s);
    if (!marker) continue;
    out.push_back(stay.pose);
    out.back().marker_in_tracker = *marker;
  }
  if (out.size() < calibration::kMinTrackerPoses)
    throw std::runtime_error(calibration::text(
        "the arm stood still %zu times for 1.5 s or more, the marker was seen at rest in %zu of them: allowed at least "
        "%zu: stop in more poses, keep the marker in sight, and export %.0f rows a second or more (here %.1f)",
        run.stays.size(), out.size(), calibration::kMinTrackerPoses, calibration::kMinTrackerRate_hz,
        static_cast<double>(tracked.size() - 1) / (tracked.back().time_s - tracked.front().time_s)));
  return out;
}

}  // namespace liana::cli
