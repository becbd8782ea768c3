#include "host/control/arbiter/path_move.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>

#include "firmware_like/math/trig.hpp"
#include "host/api/server/request_error.hpp"
#include "host/control/arbiter/cable_traits.hpp"
#include "host/control/arbiter/serial_traits.hpp"

namespace liana::arbiter {

namespace {

constexpr double kRounding_rad = 1e-9;  // of a limit that became degrees and an angle again

std::string degrees_text(double rad) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g deg", rad / kDegree);
  return text;
}

// "point 17, theta 3: ".
template <class Arm>
std::string place(std::size_t point, std::size_t joint) {
  return "point " + std::to_string(point + 1) + ", " + ArmTraits<Arm>::kJointName + " " + std::to_string(joint + 1) +
         ": ";
}

template <class Arm>
void require_start(const typename Arm::Table& table, const Joints<Arm>& command_rad, const Joints<Arm>& first_rad) {
  for (std::size_t i = 0; i < ArmTraits<Arm>::joint_count(table); ++i) {
    const double off_rad = std::fabs(first_rad[i] - command_rad[i]);
    if (off_rad <= kPathStart_deg * kDegree) continue;
    throw api::RequestError("refused", place<Arm>(0, i) + degrees_text(off_rad) +
                                           " from where the command stands: allowed " +
                                           degrees_text(kPathStart_deg * kDegree) + ": go there first with move_jp");
  }
}

}  // namespace

template <class Arm>
PathRequest<Arm> admit_path(const typename Arm::Table& table, const Joints<Arm>& command_rad,
                            PathRequest<Arm> request) {
  const std::size_t count = request.points_rad.size();
  if (count == 0 || count > kMaxPathPoints) {
    throw api::RequestError("out_of_range", "a path of " + std::to_string(count) + " points: allowed 1 to " +
                                                std::to_string(kMaxPathPoints));
  }
  for (std::size_t k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < ArmTraits<Arm>::joint_count(table); ++i) {
      double& at_rad = request.points_rad[k][i];
      const JointRange range = ArmTraits<Arm>::range_rad(table, i);
      if (!(at_rad >= range.low_rad - kRounding_rad && at_rad <= range.high_rad + kRounding_rad)) {
        throw api::RequestError("out_of_range", place<Arm>(k, i) + degrees_text(at_rad) + ": allowed " +
                                                    degrees_text(range.low_rad) + " to " +
                                                    degrees_text(range.high_rad) + ": choose another point");
      }
      at_rad = std::clamp(at_rad, range.low_rad, range.high_rad);
    }
  }
  require_start<Arm>(table, command_rad, request.points_rad.front());
  return request;
}

template <class Arm>
PathPrecheck<Arm> look_at_path(const typename Arm::Table& table, const SpeedZone& zone, const PathCheck<Arm>& check,
                               const Joints<Arm>& from_rad, const PathRequest<Arm>& request) try {
  PathPrecheck<Arm> out;
  std::vector<Joints<Arm>> points{from_rad};
  points.insert(points.end(), request.points_rad.begin(), request.points_rad.end());
  if (check) out.refusal = check(points, request.margin_m);
  if (!out.refusal.empty()) return out;
  out.path.emplace(table, points);
  out.along_rad = path_timing<Arm>(table, zone, *out.path, request.rate_rad_s);
  if (static_cast<double>(out.along_rad.size()) * interval_s(table) > kMaxPathTime_s)
    out.refusal =
        "it takes more than " + std::to_string(static_cast<int>(kMaxPathTime_s)) + " s: ask for a higher rate";
  return out;
} catch (const std::exception& error) {  // a check that fails is none that has passed
  return {error.what(), std::nullopt, {}};
}

template PathRequest<cable::CableArm> admit_path<cable::CableArm>(const cable::RobotParams&, const cable::ThetaVector&,
                                                                  PathRequest<cable::CableArm>);
template PathRequest<serial::SerialArm> admit_path<serial::SerialArm>(const serial::RobotParams&,
                                                                      const serial::JointVector&,
                                                                      PathRequest<serial::SerialArm>);
template PathPrecheck<cable::CableArm> look_at_path<cable::CableArm>(const cable::RobotParams&, const SpeedZone&,
                                                                     const PathCheck<cable::CableArm>&,
                                                                     const cable::ThetaVector&,
                                                                     const PathRequest<cable::CableArm>&);
template PathPrecheck<serial::SerialArm> look_at_path<serial::SerialArm>(const serial::RobotParams&, const SpeedZone&,
                                                                         const PathCheck<serial::SerialArm>&,
                                                                         const serial::JointVector&,
                                                                         const PathRequest<serial::SerialArm>&);
static_assert(MotionGenerator<PathMove<cable::CableArm>, cable::CableArm>);
static_assert(MotionGenerator<PathMove<serial::SerialArm>, serial::SerialArm>);

}  // namespace liana::arbiter
