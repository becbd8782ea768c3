#include "host/model/simulation/chain.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace liana::simulation {

namespace {

using Index = std::size_t;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// a b, in the order of sums that Eigen's own product has; that is a call here, at three times the cost.
Matrix3d times(const Matrix3d& a, const Matrix3d& b) {
  const auto x = a.col(0).head<2>(), y = a.col(1).head<2>(), z = a.col(2).head<2>();
  Matrix3d out;
  out.col(0).head<2>() = x * b(0, 0) + y * b(1, 0) + z * b(2, 0);
  out.col(1).head<2>() = x * b(0, 1) + y * b(1, 1) + z * b(2, 1);
  out.col(2).head<2>() = x * b(0, 2) + y * b(1, 2) + z * b(2, 2);
  for (Eigen::Index i = 0; i < 3; ++i) out(2, i) = a(2, 0) * b(0, i) + (a(2, 1) * b(1, i) + a(2, 2) * b(2, i));
  return out;
}

// Turn of one universal joint: pitch about z before yaw about y in modules 1, 3, ..., the other way round in 2, 4, ...
struct Turns {
  Matrix3d pitch_first, yaw_first;
};

// The products of both turns, written out; a zero is added where a product sums zeros, which makes none of them
// negative.
Turns turns_of(double pitch_rad, double yaw_rad) {
  const double ca = std::cos(pitch_rad), sa = std::sin(pitch_rad), cb = std::cos(yaw_rad), sb = std::sin(yaw_rad);
  const std::array<double, 9> pitch_first{ca * cb, sa * cb + 0.0, 0.0 - sb,      0.0 - sa, ca,
                                          0.0,     ca * sb + 0.0, sa * sb + 0.0, cb};
  const std::array<double, 9> yaw_first{ca * cb, sa + 0.0, 0.0 - sb * ca, 0.0 - cb * sa, ca, sb * sa + 0.0, sb + 0.0,
                                        0.0,     cb};
  return {Matrix3d(pitch_first.data()), Matrix3d(yaw_first.data())};
}

bool is_pitch_first(std::int32_t module) { return module % 2 == 0; }

// Per theta what all its joints so far do to a point p: sum of axes x (p - joint) = axes x p - moments.
struct JointSums {
  eigen::SpaceColumns axes, moments;

  void add(Eigen::Index theta, const Vector3d& axis, const Vector3d& joint_m) {
    axes.col(theta) += axis;
    moments.col(theta) += axis.cross(joint_m);
  }
};

// Nothing has moved a point yet but a base that feeds.
JointSums base_sums(const ArmModel& model, const Chain& chain) {
  const Eigen::Index thetas = eigen::theta_count(model.table);
  JointSums sums{eigen::SpaceColumns::Zero(3, thetas), eigen::SpaceColumns::Zero(3, thetas)};
  const SegmentParams& base = model.table.segment[0];
  if (!feeds(base)) return sums;
  sums.moments.col(0) = -base.slide_m_rad * Vector3d::UnitX();
  sums.add(1, Vector3d::UnitX(), chain.point_m[0]);
  return sums;
}

// Six rows a link: velocity of its centre and rate of turn about its own axes, each times the root of what resists it.
using LinkRows = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, kMaxTheta>;

LinkRows link_rows(const ArmModel& model, const SegmentParams& segment, const JointSums& sums, Eigen::Index thetas,
                   const Matrix3d& rotation, const Vector3d& centre_m) {
  const double m_kg = segment.module_mass_kg, r_m = model.link_radius_m, l_m = segment.module_length_m;
  const double along = std::sqrt(0.5 * m_kg * r_m * r_m);
  const double across = std::sqrt(m_kg * (3.0 * r_m * r_m + l_m * l_m) / 12.0);
  LinkRows rows(6, thetas);
  for (Eigen::Index i = 0; i < thetas; ++i) {
    const Vector3d axis = sums.axes.col(i);
    rows.col(i).head<3>() = std::sqrt(m_kg) * (axis.cross(centre_m) - sums.moments.col(i));
    rows.col(i).tail<3>() = Vector3d(along, across, across).cwiseProduct(rotation.transpose() * axis);
  }
  return rows;
}

Vector3d tool_centre_m(const ArmModel& model, const Chain& chain) {
  return chain.tip_m() +
         chain.rotation[static_cast<Index>(chain.links)] * Vector3d(model.table.tool.center_in_tip_m.data());
}

}  // namespace

void place(const ArmModel& model, const ThetaVector& theta_rad, Chain& chain) {
  Index link = 0;
  chain.point_m[0].setZero();
  chain.rotation[0].setIdentity();
  if (const SegmentParams& base = model.table.segment[0]; feeds(base)) {
    chain.point_m[0].x() = base.slide_m_rad * theta_rad[0];
    chain.rotation[0] = Eigen::AngleAxisd(theta_rad[1], Vector3d::UnitX());
  }
  for (Index m = 0; m < static_cast<Index>(model.table.segment_count); ++m) {
    const SegmentParams& segment = model.table.segment[m];
    const Turns turns = turns_of(theta_rad[2 * m], theta_rad[2 * m + 1]);
    for (std::int32_t k = 0; k < segment.modules; ++k, ++link) {
      chain.rotation[link + 1] = times(chain.rotation[link], is_pitch_first(k) ? turns.pitch_first : turns.yaw_first);
      chain.point_m[link + 1] = chain.point_m[link] + segment.module_length_m * chain.rotation[link + 1].col(0);
    }
  }
  chain.links = static_cast<std::int32_t>(link);
}

eigen::ThetaMatrix mass_matrix(const ArmModel& model, const Chain& chain) {
  const Eigen::Index thetas = eigen::theta_count(model.table);
  eigen::ThetaMatrix mass = eigen::ThetaMatrix::Zero(thetas, thetas);
  JointSums sums = base_sums(model, chain);
  Index link = 0;
  for (Index m = 0; m < static_cast<Index>(model.table.segment_count); ++m) {
    const SegmentParams& segment = model.table.segment[m];
    const Eigen::Index pitch = static_cast<Eigen::Index>(2 * m), moved = pitch + 2;
    for (std::int32_t k = 0; k < segment.modules; ++k, ++link) {
      // The first axis is the parent's, the second one the link's own.
      const Matrix3d &before = chain.rotation[link], &after = chain.rotation[link + 1];
      const Vector3d& joint_m = chain.point_m[link];
      sums.add(pitch, is_pitch_first(k) ? before.col(2) : after.col(2), joint_m);
      sums.add(pitch + 1, is_pitch_first(k) ? after.col(1) : before.col(1), joint_m);
      const Vector3d centre_m = 0.5 * (joint_m + chain.point_m[link + 1]);
      const LinkRows rows = link_rows(model, segment, sums, moved, after, centre_m);
      mass.topLeftCorner(moved, moved) += rows.transpose().lazyProduct(rows);
    }
  }
  if (const double tool_kg = model.table.tool.mass_kg; tool_kg > 0.0) {
    const Vector3d tool_m = tool_centre_m(model, chain);
    eigen::SpaceColumns moves(3, thetas);
    for (Eigen::Index i = 0; i < thetas; ++i) moves.col(i) = sums.axes.col(i).cross(tool_m) - sums.moments.col(i);
    mass += tool_kg * moves.transpose().lazyProduct(moves);
  }
  return mass;
}

eigen::ThetaColumn static_load(const ArmModel& model, const ThetaVector& theta_rad, const Chain& chain) {
  const cable::RobotParams& table = model.table;
  const Eigen::Index thetas = eigen::theta_count(table);
  const Vector3d gravity(table.gravity_m_s2.data());
  eigen::ThetaColumn load = eigen::ThetaColumn::Zero(thetas);
  JointSums sums = base_sums(model, chain);
  const auto weigh = [&](double mass_kg, const Vector3d& at_m) {
    for (Eigen::Index i = 0; i < thetas; ++i)
      load(i) -= mass_kg * gravity.dot(sums.axes.col(i).cross(at_m) - sums.moments.col(i));
  };
  Index link = 0;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    const SegmentParams& segment = table.segment[m];
    const Eigen::Index pitch = static_cast<Eigen::Index>(2 * m);
    for (std::int32_t k = 0; k < segment.modules; ++k, ++link) {
      const Matrix3d &before = chain.rotation[link], &after = chain.rotation[link + 1];
      const Vector3d& joint_m = chain.point_m[link];
      sums.add(pitch, is_pitch_first(k) ? before.col(2) : after.col(2), joint_m);
      sums.add(pitch + 1, is_pitch_first(k) ? after.col(1) : before.col(1), joint_m);
      weigh(segment.module_mass_kg, joint_m + segment.module_center * (chain.point_m[link + 1] - joint_m));
    }
    for (Index axis = 0; axis < 2; ++axis)
      load(pitch + static_cast<Eigen::Index>(axis)) +=
          segment.modules * segment.joint_stiffness_Nm_rad * (theta_rad[2 * m + axis] - segment.joint_rest_rad[axis]);
  }
  weigh(table.tool.mass_kg, tool_centre_m(model, chain));
  return load;
}

}  // namespace liana::simulation
