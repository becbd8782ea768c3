#include "host/drives/calibration/calibrate.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/math/convert.hpp"
#include "host/drives/calibration/jig.hpp"
#include "host/drives/calibration/text.hpp"
#include "host/model/config/drive_names.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using Index = std::size_t;
constexpr Eigen::Index column(Index i) { return static_cast<Eigen::Index>(i); }
using Changes = Eigen::Ref<const Eigen::VectorXd>;  // of one length, pose by pose, about their mean [m]

// Shares of the hole radius, which is 25 mm at the published arm.
constexpr double kChangeShare = 0.16;
constexpr double kApartShare = 0.04;   // between two cables, to tell them apart
constexpr double kMisfitShare = 0.02;  // of a fitted drum; elongation and hole radius bring a tenth of that
constexpr double kDrumShare = 0.02;

// Of a segment (0-based); a base goes by the segment beyond it.
double hole_radius_m(const RobotParams& robot, Index segment) {
  return robot.segment[std::max(segment, as_index(robot.first_bending()))].hole_radius_m;
}

Index segment_of(const config::RobotConfig& robot, Index cable) {
  return as_index(config::DriveNames(robot.table).segment_of(cable) - 1);
}

double max_misfit_m(const config::RobotConfig& robot, Index cable) {
  return kMisfitShare * hole_radius_m(robot.table, segment_of(robot, cable));
}

// Largest |a scale - b| over the poses.
double misfit_m(const Changes& a, double scale, const Changes& b) { return (scale * a - b).lpNorm<Eigen::Infinity>(); }

// What the drives report and what the geometry says: changes between poses, by drive and by cable, and the means they
// are about.
struct Lengths {
  Eigen::MatrixXd reported, expected;  // rows are poses
  Eigen::RowVectorXd reported_mean_m, expected_mean_m;
};

Lengths lengths_of(const config::RobotConfig& robot, std::span<const CalibrationReading> readings) {
  const Eigen::Index cables = robot.table.cable_count(), poses = static_cast<Eigen::Index>(readings.size());
  Lengths out{Eigen::MatrixXd(poses, cables), Eigen::MatrixXd(poses, cables), {}, {}};
  for (Eigen::Index p = 0; p < poses; ++p) {
    const CalibrationReading& reading = readings[static_cast<Index>(p)];
    const CableVector expected_m = beyond_zero_m(robot.table, reading.theta_rad, reading.tension_N);
    out.reported.row(p) = Eigen::Map<const Eigen::RowVectorXd>(reading.position_m.data(), cables);
    out.expected.row(p) = Eigen::Map<const Eigen::RowVectorXd>(expected_m.data(), cables);
  }
  out.reported_mean_m = out.reported.colwise().mean();
  out.expected_mean_m = out.expected.colwise().mean();
  out.reported.rowwise() -= out.reported_mean_m;
  out.expected.rowwise() -= out.expected_mean_m;
  return out;
}

// How a drive's report follows a cable: the factor that fits best, and what is left over.
struct Fit {
  double scale = 0.0;
  double misfit_m = 0.0;
};

Fit fit(const Changes& reported, const Changes& expected) {
  const double squares = reported.squaredNorm();
  const double scale = squares > 0.0 ? reported.dot(expected) / squares : 0.0;
  return {scale, misfit_m(reported, scale, expected)};
}

bool is_drum(const Fit& found, double max_m) {
  return found.misfit_m <= max_m && std::fabs(std::fabs(found.scale) - 1.0) <= kDrumShare;
}

// The other cable that a drive follows as if it were its own.
std::optional<Index> followed_by(const config::RobotConfig& robot, const Lengths& lengths, Index drive) {
  std::optional<Index> best;
  double least_m = std::numeric_limits<double>::infinity();
  for (Index cable = 0; cable < Index(lengths.expected.cols()); ++cable) {
    const Fit found = fit(lengths.reported.col(column(drive)), lengths.expected.col(column(cable)));
    if (!is_drum(found, max_misfit_m(robot, cable)) || found.misfit_m >= least_m) continue;
    best = cable;
    least_m = found.misfit_m;
  }
  return best;
}

std::string problem_of(const config::RobotConfig& robot, const Lengths& lengths, Index drive, const Fit& own) {
  const std::optional<Index> other = followed_by(robot, lengths, drive);
  const config::DriveNames names(robot);
  const std::string who = names.drive(drive);
  if (other && *other != drive)
    return who + " moves as " + names.cable(*other) +
           " does, not as its own: their cables are exchanged: wind each cable on its own drum, or exchange the "
           "drives' node ids, then calibrate again";
  const double max_m = max_misfit_m(robot, drive);
  if (own.misfit_m <= max_m) {
    return text(
        "%s: drum radius %.4f mm: allowed %.4f mm +- %.0f %%: look whether cable lies on cable, or correct "
        "drives.drum_radius_m of robot %s",
        who.c_str(), 1e3 * std::fabs(own.scale) * robot.drum_radius_m, 1e3 * robot.drum_radius_m, 100.0 * kDrumShare,
        robot.name.c_str());
  }
  return text(
      "%s: its position misses the jigs' poses by %.1f mm: allowed %.2g mm: look whether the arm lies in every "
      "jig and the cable is on its drum",
      who.c_str(), 1e3 * own.misfit_m, 1e3 * max_m);
}

// Without a number of its own a drive cannot be told from another one when it is swapped later. Empty: it has one.
std::string serial_problem_of(const config::RobotConfig& robot, std::span<const CalibrationReading> readings,
                              Index drive) {
  const std::uint32_t serial = readings.front().serial[drive];
  const config::DriveNames names(robot);
  const std::string who = names.drive(drive) + text(": serial number %u (object 0x1018:4)", serial);
  if (serial == 0)
    return who +
           ": allowed 1 or more: a drive without a number of its own cannot be told from another: give it one, or take "
           "another";
  for (const CalibrationReading& reading : readings) {
    if (reading.serial[drive] != serial)
      return who + text(" in the first jig, %u in another: leave the drives where they are, then calibrate again",
                        reading.serial[drive]);
  }
  for (Index other = 0; other < as_index(robot.table.cable_count()); ++other) {
    const bool is_same_node = names.place_of(other).node == names.place_of(drive).node;
    if (!is_same_node && readings.front().serial[other] == serial)
      return who + ": " + names.drive(other) + " says it, too: give each a number of its own";
  }
  return "";
}

CableCalibration cable_of(const config::RobotConfig& robot, const Lengths& lengths, Index c, double scale,
                          const CalibrationReading& first) {
  const DriveParams& table = robot.table.drive[c];
  // expected = scale reported + zero; reported is what the table's drum and direction make of the counts.
  const double zero_m = lengths.expected_mean_m[column(c)] - scale * lengths.reported_mean_m[column(c)];
  CableCalibration out;
  out.serial = first.serial[c];
  out.direction = scale > 0.0 ? table.direction : -table.direction;
  out.drum_radius_m = std::fabs(scale) * robot.drum_radius_m;
  out.zero_counts = to_counts(table.zero_counts - zero_m / (scale * table.direction * table.metres_per_count)).value;
  out.pretension_N = first.tension_N[c];
  out.offset_m = zero_m;
  return out;
}

// Whether two cables of one segment end in holes opposite each other: what one gains the other loses, in every pose.
bool are_opposite(const RobotParams& robot, Index a, Index b) {
  constexpr double kOpposite = -0.9998;  // cosine of 179 deg
  const CableLayout layout = cable_layout(robot);
  if (layout.segment[a] != layout.segment[b]) return false;
  const double along = layout.hole_y_m[a] * layout.hole_y_m[b] + layout.hole_z_m[a] * layout.hole_z_m[b];
  const double radius_m = robot.segment[static_cast<Index>(layout.segment[a])].hole_radius_m;
  return along < kOpposite * radius_m * radius_m;
}

[[noreturn]] void refuse_alike(const RobotParams& robot, Index a, Index b) {
  const config::DriveNames names(robot);
  const std::string who = names.cable(a) + " and " + names.cable(b);
  if (are_opposite(robot, a, b))
    throw std::runtime_error(who +
                             " sit opposite each other in one segment and change alike in "
                             "every pose: no pose tells them apart: turn one of their holes, cables.phase_deg, by 15 "
                             "deg or more");
  throw std::runtime_error(who +
                           " change alike between these poses: add one that bends the arm "
                           "another way");
}

}  // namespace

double min_change_m(const RobotParams& robot, std::size_t segment) {
  return kChangeShare * hole_radius_m(robot, segment);
}

void check_poses(const config::RobotConfig& robot, std::span<const ThetaVector> poses_rad) {
  if (poses_rad.size() < 2) throw std::runtime_error("one pose says nothing of drums and directions: give two or more");
  CableVector tension_N;
  tension_N.fill(robot.table.tension.plan_N);
  std::vector<CalibrationReading> readings;
  for (const ThetaVector& theta_rad : poses_rad) readings.push_back({theta_rad, {}, tension_N});
  const Eigen::MatrixXd cables = lengths_of(robot, readings).expected;
  for (Index a = 0; a < Index(cables.cols()); ++a) {
    const double min_m = min_change_m(robot.table, segment_of(robot, a));
    if (cables.col(column(a)).lpNorm<Eigen::Infinity>() < min_m)
      throw std::runtime_error(
          config::DriveNames(robot.table).cable(a) +
          text(" changes by less than %.2g mm between these poses: add one that bends its segment more", 1e3 * min_m));
    for (Index b = 0; b < Index(cables.cols()); ++b) {
      const Fit alike = fit(cables.col(column(a)), cables.col(column(b)));
      if (a != b && alike.misfit_m < kApartShare * hole_radius_m(robot.table, segment_of(robot, b)) &&
          std::fabs(std::fabs(alike.scale) - 1.0) <= 2.0 * kDrumShare)
        refuse_alike(robot.table, a, b);
    }
  }
}

CalibrationResult calibrate(const config::RobotConfig& robot, std::span<const CalibrationReading> readings,
                            const std::string& date) {
  const Lengths lengths = lengths_of(robot, readings);
  CalibrationResult out;
  out.calibration = {robot.name, config::sha256_hex(robot.canonical_json), date, {}};
  for (Index c = 0; c < as_index(robot.table.cable_count()); ++c) {
    const Fit own = fit(lengths.reported.col(column(c)), lengths.expected.col(column(c)));
    const std::string serial_problem = serial_problem_of(robot, readings, c);
    if (!serial_problem.empty()) out.problems.push_back(serial_problem);
    if (!is_drum(own, max_misfit_m(robot, c))) {
      out.problems.push_back(problem_of(robot, lengths, c, own));
    } else {
      out.calibration.cables.push_back(cable_of(robot, lengths, c, own.scale, readings.front()));
    }
  }
  return out;
}

}  // namespace liana::calibration
