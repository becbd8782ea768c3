#include "host/apps/cli/pose_json.hpp"

#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::cli {

Json degrees_json(std::span<const double> angle_rad, std::int32_t count) {
  Json list = Json::array();
  for (const double each_rad : angle_rad.first(as_index(count))) list.push_back(each_rad / kDegree);
  return list;
}

Json homogeneous(const Pose& pose) {
  Json rows = Json::array();
  for (std::size_t row = 0; row < 3; ++row) {
    Json values = Json::array();
    for (std::size_t column = 0; column < 3; ++column) {
      Vec3 axis{};
      axis[column] = 1.0;
      values.push_back(rotate(pose.quaternion, axis)[row]);
    }
    values.push_back(pose.position_m[row]);
    rows.push_back(values);
  }
  rows.push_back({0.0, 0.0, 0.0, 1.0});
  return rows;
}

Json jacobian_rows(std::span<const Vec3> linear, std::span<const Vec3> angular, std::int32_t columns) {
  Json rows = Json::array();
  for (std::size_t row = 0; row < 6; ++row) {
    Json values = Json::array();
    for (std::size_t i = 0; i < static_cast<std::size_t>(columns); ++i)
      values.push_back(row < 3 ? linear[i][row] : angular[i][row - 3]);
    rows.push_back(values);
  }
  return rows;
}

}  // namespace liana::cli
