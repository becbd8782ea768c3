#include "host/apps/cli/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "firmware_like/cable/arm/setpoint.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/base/options/nearest.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/serial_robot.hpp"
#include "host/model/config/theta_numbers.hpp"

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

// An angle that was measured at a limit lies a hair beyond it now and then: it is taken as the limit, and that is said.
// Less than what degrees lose on their way through radians and back is not.
double within_deg(std::string_view option, std::string_view text, const char* joint, std::size_t index, double low_deg,
                  double high_deg) {
  constexpr double kHair_deg = 1e-6 / kDegree;
  const double angle_deg = parse_number(option, text), taken_deg = std::clamp(angle_deg, low_deg, high_deg);
  const double beyond_deg = std::fabs(angle_deg - taken_deg);
  const std::string which = std::string(joint) + " " + std::to_string(index + 1);
  const auto shown = [](double value_deg) { return short_number(std::round(value_deg * 1e9) / 1e9); };
  if (beyond_deg > kHair_deg)
    refuse(option, text, which + " from " + shown(low_deg) + " to " + shown(high_deg) + " deg");
  if (beyond_deg > 1e-12 * std::max(std::fabs(low_deg), std::fabs(high_deg)))
    std::fprintf(stderr, "note: %.*s: %s: %.*s deg is taken as the limit, %s deg\n", static_cast<int>(option.size()),
                 option.data(), which.c_str(), static_cast<int>(text.size()), text.data(), shown(taken_deg).c_str());
  return taken_deg;
}

double checked_angle_deg(std::string_view option, std::string_view text, const cable::RobotParams& robot,
                         std::size_t theta) {
  const double limit_deg = theta_limit_rad(robot, theta) / kDegree;
  return within_deg(option, text, "theta", theta, -limit_deg, limit_deg);
}

// A name, rather than angles that lack something.
bool is_word(std::string_view text) { return text.find(',') == text.npos && !finite_number(text); }

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
  const auto parts = split(text, ',');
  parse_numbers(option, text, robot.joints());
  serial::JointVector joint_rad{};
  for (std::size_t i = 0; i < robot.joints(); ++i) {
    const serial::JointParams& joint = robot.joint[i];
    const double angle_deg =
        within_deg(option, parts[i], "joint", i, joint.low_rad / kDegree, joint.high_rad / kDegree);
    joint_rad[i] = std::clamp(angle_deg * kDegree, joint.low_rad, joint.high_rad);  // degrees went through radians
  }
  return joint_rad;
}

cable::ThetaVector parse_pose_deg(std::string_view option, const std::string& text, const config::RobotConfig& robot) {
  if (const auto named = robot.named_poses_deg.find(text); named != robot.named_poses_deg.end())
    return config::theta_rad(named->second);
  if (is_word(text))
    refuse_pose(option, text, static_cast<std::size_t>(robot.table.theta_count()), robot.name, robot.named_poses_deg);
  return parse_theta_deg(option, text, robot.table);
}

serial::JointVector parse_pose_deg(std::string_view option, const std::string& text,
                                   const config::SerialRobotConfig& robot) {
  const auto named = robot.named_poses_deg.find(text);
  if (named == robot.named_poses_deg.end()) {
    if (is_word(text)) refuse_pose(option, text, robot.table.joints(), robot.name, robot.named_poses_deg);
    return parse_joint_deg(option, text, robot.table);
  }
  serial::JointVector joint_rad{};
  for (std::size_t i = 0; i < named->second.size(); ++i) joint_rad[i] = named->second[i] * kDegree;
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
