#include "host/drives/calibration/jig.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "firmware_like/cable/arm/tension.hpp"
#include "host/base/options/nearest.hpp"
#include "host/drives/calibration/text.hpp"
#include "host/model/config/drive_names.hpp"
#include "host/model/config/theta_numbers.hpp"

namespace liana::calibration {

using namespace cable;
namespace {

using Index = std::size_t;

constexpr double kApart = 3.0;  // times the tolerance: then a pose off by all of it still shows an exchange
constexpr Index kNamed = 3;

bool is_off(double reported_m, double expected_m) {
  return !(std::fabs(reported_m - expected_m) <= kFixtureTolerance_m);
}

// Of the drives that are off, two that read what the other one should.
std::string exchanged(const config::DriveNames& names, const std::vector<Index>& off, const CableVector& reported_m,
                      const CableVector& expected_m) {
  for (const Index a : off) {
    for (const Index b : off) {
      if (a >= b || is_off(reported_m[a], expected_m[b]) || is_off(reported_m[b], expected_m[a])) continue;
      return "; " + names.drive(a) + " and " + names.drive(b) +
             " read what the other one should: their cables are exchanged";
    }
  }
  return "";
}

}  // namespace

std::string whole_turns(const config::RobotConfig& robot, std::size_t drive, double off_m) {
  const double turn_m = robot.counts_per_turn * robot.table.drive[drive].metres_per_count;
  const double turns = turn_m > 0.0 ? std::round(off_m / turn_m) : 0.0;
  const bool is_whole =
      turns != 0.0 && std::fabs(off_m - turns * turn_m) <= kFixtureTolerance_m && turn_m > 4.0 * kFixtureTolerance_m;
  if (!is_whole) return "";
  return std::fabs(turns) == 1.0 ? "one turn" : text("%.0f turns", std::fabs(turns));
}

ThetaVector named_pose_rad(const config::RobotConfig& robot, const std::string& name) {
  const auto found = robot.named_poses_deg.find(name);
  if (found == robot.named_poses_deg.end())
    throw std::runtime_error("pose '" + name + "': allowed are the named poses of robot " + robot.name + ": " +
                             options::allowed_names(name, options::names_of(robot.named_poses_deg)));
  return config::theta_rad(found->second);
}

CableVector beyond_zero_m(const RobotParams& table, const ThetaVector& theta_rad, const CableVector& tension_N) {
  const CableLayout layout = cable_layout(table);
  const ArmTrig trig = arm_trig(table, theta_rad);
  const CableGeometry geometry = cable_geometry(table, layout, trig);
  CableVector out =
      payout_for(table, layout, geometry.part_m, tension_ratio(table, layout, trig, SlipState{}), tension_N);
  for (Index c = 0; c < static_cast<Index>(table.cable_count()); ++c) out[c] -= layout.zero_length_m[c] + table.lead_m;
  return out;
}

void check_tells_apart(const config::RobotConfig& robot, const std::string& name) {
  const config::DriveNames names(robot);
  CableVector tension_N;
  tension_N.fill(robot.table.tension.plan_N);
  const CableVector expected_m = beyond_zero_m(robot.table, named_pose_rad(robot, name), tension_N);
  for (Index a = 0; a < static_cast<Index>(robot.table.cable_count()); ++a) {
    for (Index b = 0; b < a; ++b) {
      const double apart_m = std::fabs(expected_m[a] - expected_m[b]);
      if (apart_m >= kApart * kFixtureTolerance_m) continue;
      throw std::runtime_error("pose '" + name + "': " + names.cable(b) + " and " + names.cable(a) +
                               text(" are only %.1f mm apart there, so that nobody would see them exchanged: allowed "
                                    "are poses that tell every two cables apart by %.0f mm",
                                    1e3 * apart_m, 1e3 * kApart * kFixtureTolerance_m));
    }
  }
}

std::string contradiction(const config::RobotConfig& robot, const std::string& name, const CableVector& paid_out_m,
                          const CableVector& tension_N) {
  const CableVector expected_m = beyond_zero_m(robot.table, named_pose_rad(robot, name), tension_N);
  std::vector<Index> off;
  for (Index c = 0; c < static_cast<Index>(robot.table.cable_count()); ++c) {
    if (is_off(paid_out_m[c], expected_m[c])) off.push_back(c);
  }
  if (off.empty()) return "";
  const auto by_m = [&](Index c) { return std::fabs(paid_out_m[c] - expected_m[c]); };
  std::stable_sort(off.begin(), off.end(), [&](Index a, Index b) { return by_m(a) > by_m(b); });
  const config::DriveNames names(robot);
  std::string out = "the arm does not lie in pose " + name + ": ";
  for (Index i = 0; i < std::min(off.size(), kNamed); ++i) {
    const double off_m = paid_out_m[off[i]] - expected_m[off[i]];
    const std::string turns = whole_turns(robot, off[i], off_m);
    out += (i == 0 ? "" : ", ") + names.drive(off[i]) + text(" is off by %+.1f mm", 1e3 * off_m) +
           (turns.empty() ? "" : ", which is " + turns + " of its encoder");
  }
  if (off.size() > kNamed) out += text(" and %zu more", off.size() - kNamed);
  out += text(", allowed %.0f mm", 1e3 * kFixtureTolerance_m);
  return out + exchanged(names, off, paid_out_m, expected_m) +
         "; put the arm into its jig, look whether each cable is taut and on its own drum, then run liana "
         "calibrate";
}

}  // namespace liana::calibration
