// Angles, poses and Jacobians as commands print them, whatever arm they are of.
#pragma once

#include <cstdint>
#include <span>

#include "firmware_like/math/pose.hpp"
#include "host/base/json/json.hpp"

namespace liana::cli {

// The first `count` angles, in degrees.
Json degrees_json(std::span<const double> angle_rad, std::int32_t count);

// The 4 x 4 matrix of a pose, row by row.
Json homogeneous(const Pose& pose);

// The 6 x `columns` Jacobian, row by row: linear first.
Json jacobian_rows(std::span<const Vec3> linear, std::span<const Vec3> angular, std::int32_t columns);

}  // namespace liana::cli
