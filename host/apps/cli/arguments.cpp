#include "host/apps/cli/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "firmware_like/cable/arm/setpoint.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/base/options/nearest.hpp"

namespace liana::cli {
namespace {

constexpr double kFarthest_m = 1000.0;  // no arm reaches so far, and squares of it are no problem for anybody
constexpr double kLargestWeight = 1000.0;
constexpr std::int64_t kLargestSeed = (std::int64_t{1} << 53) - 1;

[[noreturn]] void refuse(std::string_view option, std::string_view value, const std::string& allowed) {
  throw launcher::BadInput(std::string(option) + ": '" + std::string(value) + "': allowed: " + allowed);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = text.find(separator);
    parts.push_back(text.substr(0, at));
    if (at == std::string_view::npos) return parts;
    text.remove_prefix(at + 1);
  }
}

// All of `text`; nothing when it is no finite number.
std::optional<double> finite_number(std::string_view text) {
  double value = 0.0;
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string short_number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

Vec3 checked_position(std::string_view option, std::string_view text, const std::vector<double>& v) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::fabs(v[i]) > kFarthest_m) refuse(option, text, "coordinates within +-" + short_number(kFarthest_m) + " m");
  }
  return {v[0], v[1], v[2]};
}

double theta_limit_rad(const cable::RobotParams& robot, std::size_t theta) {
  return robot.segment[theta / 2].theta_limit_rad;
}

double checked_angle_deg(std::string_view option, std::string_view text, const cable::RobotParams& robot,
                         std::size_t theta) {
  const double angle_deg = parse_number(option, text);
  const double limit_deg = theta_limit_rad(robot, theta) / kDegree;
  // The limit itself is allowed; its degrees went through radians and back.
  if (std::fabs(angle_deg) > limit_deg * (1.0 + 1e-12)) {
    refuse(
        option, text,
        "theta " + std::to_string(theta + 1) + " within +-" + short_number(std::round(limit_deg * 1e9) / 1e9) + " deg");
  }
  return angle_deg;
}

}  // namespace

double parse_number(std::string_view option, std::string_view text) {
  const std::optional<double> value = finite_number(text);
  if (!value) refuse(option, text, "a finite number");
  return *value;
}

double parse_number_in(std::string_view option, std::string_view text, double least, double most,
                       std::string_view unit) {
  const std::optional<double> value = finite_number(text);
  if (!value || *value < least || *value > most)
    refuse(option, text, short_number(least) + " to " + short_number(most) + " " + std::string(unit));
  return *value;
}

std::int64_t parse_whole(std::string_view option, std::string_view text, std::int64_t least, std::int64_t most,
                         std::string_view note) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < least || value > most) {
    refuse(option, text,
           "a whole number from " + std::to_string(least) + " to " + std::to_string(most) + std::string(note));
  }
  return value;
}

std::int32_t parse_node(std::string_view option, std::string_view text, const cable::RobotParams& robot) {
  return static_cast<std::int32_t>(
      parse_whole(option, text, 1, robot.segment_count, ": a node (the end of a segment)"));
}

std::uint64_t parse_seed(std::string_view option, std::string_view text) {
  return static_cast<std::uint64_t>(parse_whole(option, text, 0, kLargestSeed));
}

std::vector<double> parse_numbers(std::string_view option, std::string_view text, std::size_t count) {
  const auto parts = split(text, ',');
  if (parts.size() != count) {
    refuse(
        option, text,
        std::to_string(count) + " numbers separated by commas, not " + std::to_string(text.empty() ? 0 : parts.size()));
  }
  std::vector<double> values;
  for (const std::string_view part : parts) values.push_back(parse_number(option, part));
  return values;
}

cable::ThetaVector parse_theta_deg(std::string_view option, std::string_view text, const cable::RobotParams& robot) {
  const auto count = static_cast<std::size_t>(robot.theta_count());
  const auto parts = split(text, ',');
  parse_numbers(option, text, count);
  cable::ThetaVector theta_rad{};
  for (std::size_t i = 0; i < count; ++i) theta_rad[i] = checked_angle_deg(option, parts[i], robot, i) * kDegree;
  return theta_rad;
}

serial::JointVector parse_joint_deg(std::string_view option, std::string_view text, const serial::RobotParams& robot) {
  const std::vector<double> angles_deg = parse_numbers(option, text, robot.joints());
  serial::JointVector joint_rad{};
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    const serial::JointParams& joint = robot.joint[i];
    const double low_deg = std::round(joint.low_rad / kDegree * 1e9) / 1e9;
    const double high_deg = std::round(joint.high_rad / kDegree * 1e9) / 1e9;
    if (angles_deg[i] < low_deg || angles_deg[i] > high_deg) {
      refuse(option, text,
             "joint " + std::to_string(i + 1) + " from " + short_number(low_deg) + " to " + short_number(high_deg) +
                 " deg");
    }
    // The ends are allowed; their degrees went through radians and back.
    joint_rad[i] = std::clamp(angles_deg[i] * kDegree, joint.low_rad, joint.high_rad);
  }
  return joint_rad;
}

void refuse_pose(std::string_view option, std::string_view text, std::size_t count, const std::string& robot,
                 const std::map<std::string, std::vector<double>>& poses) {
  refuse(option, text,
         std::to_string(count) + " angles, or a pose of robot " + robot + ": " +
             options::allowed_names(text, options::names_of(poses)));
}

Pose parse_pose(std::string_view option, std::string_view text) {
  const auto v = parse_numbers(option, text, 7);
  const Pose pose{checked_position(option, text, v), {v[3], v[4], v[5], v[6]}};
  const double length = std::sqrt(v[3] * v[3] + v[4] * v[4] + v[5] * v[5] + v[6] * v[6]);
  if (std::fabs(length - 1.0) > 1e-6) {
    refuse(
        option, text,
        "x,y,z,qw,qx,qy,qz with a quaternion of length 1 within 1e-6, not " + short_number(length) + "; normalise it");
  }
  return pose;
}

std::vector<HoldArgument> parse_hold(std::string_view text, const cable::RobotParams& robot) {
  std::vector<HoldArgument> holds;
  for (const std::string_view part : split(text, ',')) {
    const std::size_t equals = part.find('=');
    HoldArgument hold;
    hold.theta =
        static_cast<std::int32_t>(parse_whole("--hold", part.substr(0, equals), 1, robot.theta_count(), ": a theta"));
    for (const HoldArgument& other : holds) {
      if (other.theta == hold.theta) refuse("--hold", text, "each theta at most once");
    }
    if (equals != std::string_view::npos) {
      hold.has_value = true;
      hold.value_deg =
          checked_angle_deg("--hold", part.substr(equals + 1), robot, static_cast<std::size_t>(hold.theta - 1));
    }
    holds.push_back(hold);
  }
  return holds;
}

ControlPointArgument parse_control_point(std::string_view text, const cable::RobotParams& robot) {
  const auto parts = split(text, ':');
  if (parts.size() != 2 && parts.size() != 3) refuse("--control-point", text, "NODE:x,y,z or NODE:x,y,z:WEIGHT");
  ControlPointArgument point;
  point.node = parse_node("--control-point", parts[0], robot);
  point.position_m = checked_position("--control-point", parts[1], parse_numbers("--control-point", parts[1], 3));
  point.weight = parts.size() == 3 ? parse_number("--control-point", parts[2]) : default_node_weight(robot, point.node);
  if (point.weight <= 0.0 || point.weight > kLargestWeight) {
    refuse("--control-point", text, "a weight over 0, up to " + short_number(kLargestWeight));
  }
  return point;
}

}  // namespace liana::cli
