#include "host/operator/haptics/delta.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace liana::haptics {
namespace {

constexpr double kHalfRoot3 = std::numbers::sqrt3 / 2.0;
constexpr std::array<Vec3, 3> kRadial{Vec3{0.0, 1.0, 0.0}, Vec3{0.0, -0.5, kHalfRoot3}, Vec3{0.0, -0.5, -kHalfRoot3}};
constexpr Vec3 kAxis{1.0, 0.0, 0.0};
constexpr double kSingular = 1e-6;  // of the lengths multiplied

Vec3 elbow(const DeltaTable& table, std::size_t leg, double angle_rad) {
  return add(scale(kRadial[leg], table.base_m + table.upper_m * std::cos(angle_rad)),
             scale(kAxis, table.upper_m * std::sin(angle_rad)));
}

// How the elbow moves with its angle.
Vec3 elbow_rate(const DeltaTable& table, std::size_t leg, double angle_rad) {
  return add(scale(kRadial[leg], -table.upper_m * std::sin(angle_rad)),
             scale(kAxis, table.upper_m * std::cos(angle_rad)));
}

}  // namespace

// Three spheres of one radius meet above the centre of the circle through their centres.
std::optional<Vec3> delta_position(const DeltaTable& table, const JointAngles& angles_rad) noexcept {
  const Vec3 first = elbow(table, 0, angles_rad[0]);
  const Vec3 a = subtract(elbow(table, 1, angles_rad[1]), first);
  const Vec3 b = subtract(elbow(table, 2, angles_rad[2]), first);
  const Vec3 normal = cross(a, b);
  const double area2 = dot(normal, normal);
  if (!(area2 > kSingular * dot(a, a) * dot(b, b))) return std::nullopt;
  const Vec3 centre = scale(cross(subtract(scale(b, dot(a, a)), scale(a, dot(b, b))), normal), 0.5 / area2);
  const double height2 = table.lower_m * table.lower_m - dot(centre, centre);
  if (!(height2 > 0.0)) return std::nullopt;
  const double height = std::copysign(std::sqrt(height2 / area2), normal[0]);
  return add(add(first, centre), scale(normal, height));
}

std::optional<JointAngles> delta_angles(const DeltaTable& table, const Vec3& position_m) noexcept {
  JointAngles angles{};
  for (std::size_t leg = 0; leg < 3; ++leg) {
    // In the leg's plane: u outwards, w along the axis; what stands across shortens the lower arm.
    const double u = dot(position_m, kRadial[leg]) - table.base_m, w = position_m[0];
    const double from_joint2 = dot(position_m, position_m) + table.base_m * (table.base_m - 2.0 * (u + table.base_m));
    const double k =
        (from_joint2 + table.upper_m * table.upper_m - table.lower_m * table.lower_m) / (2.0 * table.upper_m);
    const double in_plane = std::sqrt(u * u + w * w);
    if (!(std::fabs(k) < in_plane)) return std::nullopt;
    angles[leg] = std::atan2(w, u) - std::acos(k / in_plane);
  }
  return angles;
}

// (p - elbow_i) . (v - elbow_rate_i qdot_i) = 0 for each leg.
std::optional<std::array<Vec3, 3>> delta_jacobian(const DeltaTable& table, const JointAngles& angles_rad) noexcept {
  const auto position = delta_position(table, angles_rad);
  if (!position) return std::nullopt;
  std::array<Vec3, 3> lower{};
  for (std::size_t leg = 0; leg < 3; ++leg) lower[leg] = subtract(*position, elbow(table, leg, angles_rad[leg]));
  const double volume = dot(lower[0], cross(lower[1], lower[2]));
  if (!(std::fabs(volume) > kSingular * table.lower_m * table.lower_m * table.lower_m)) return std::nullopt;
  std::array<Vec3, 3> columns{};
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const double push = dot(lower[leg], elbow_rate(table, leg, angles_rad[leg]));
    if (!(std::fabs(push) > kSingular * table.upper_m * table.lower_m)) return std::nullopt;
    columns[leg] = scale(cross(lower[(leg + 1) % 3], lower[(leg + 2) % 3]), push / volume);
  }
  return columns;
}

}  // namespace liana::haptics
