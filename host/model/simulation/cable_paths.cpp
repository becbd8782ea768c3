#include "host/model/simulation/cable_paths.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>

namespace liana::simulation {

namespace {

using Index = std::size_t;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kMaxTurns = 50;
// Assumed, of a rack or a belt; what it is barely matters where nothing pushes.
constexpr double kFeedStiffness_N_per_m = 3e5;
constexpr double kFloorRounding_N = 1e-6;

// A joint's turn, pitch first, and its derivatives. With yaw first the distances are the same, by reflection in the
// plane of the disc.
struct Turn {
  Matrix3d now, by_pitch, by_yaw;
};

Turn turn_of(double pitch_rad, double yaw_rad) {
  const double ca = std::cos(pitch_rad), sa = std::sin(pitch_rad), cb = std::cos(yaw_rad), sb = std::sin(yaw_rad);
  Turn turn;
  turn.now << ca * cb, -sa, ca * sb, sa * cb, ca, sa * sb, -sb, 0, cb;
  turn.by_pitch << -sa * cb, -ca, -sa * sb, ca * cb, -sa, ca * sb, 0, 0, 0;
  turn.by_yaw << -ca * sb, 0, ca * cb, -sa * sb, 0, sa * cb, -cb, 0, -sb;
  return turn;
}

// A cable across one joint, from the hole before it to the hole behind it.
struct Gap {
  double length_m = 0.0, by_pitch_m = 0.0, by_yaw_m = 0.0, wrap_rad = 0.0;
};

Gap gap_of(const Turn& turn, double face_m, double y_m, double z_m) {
  const Vector3d hole(face_m, y_m, z_m);
  const Vector3d across = turn.now * hole - Vector3d(-face_m, y_m, z_m);
  const double length_m = across.norm();
  const Vector3d along = across / length_m;
  const auto angle = [](double cosine) { return std::acos(std::fmin(1.0, std::fmax(-1.0, cosine))); };
  return {length_m, along.dot(turn.by_pitch * hole), along.dot(turn.by_yaw * hole),
          angle(along.x()) + angle(along.dot(turn.now.col(0)))};
}

}  // namespace

CablePaths cable_paths(const ArmModel& model, const ThetaVector& theta_rad) {
  const RobotParams& table = model.table;
  const Eigen::Index cables = table.cable_count(), thetas = table.theta_count();
  CablePaths paths;
  paths.jacobian_m_rad.setZero(cables, thetas);
  paths.wrap_to_rad.setZero(cables, thetas);
  paths.stiffness_N_per_m.setConstant(cables, table.lead_m);  // the free length first
  paths.wrap_rad.setZero(cables);
  std::array<Turn, kMaxSegments> turns;
  const Index feed_count = static_cast<Index>(table.feed_count()), first = static_cast<Index>(table.first_bending());
  paths.feed_count = table.feed_count();
  for (Index m = first; m < static_cast<Index>(table.segment_count); ++m)
    turns[m] = turn_of(theta_rad[2 * m], theta_rad[2 * m + 1]);
  Eigen::Index cable = paths.feed_count;
  for (Index anchor = first; anchor < static_cast<Index>(table.segment_count); ++anchor) {
    for (Index c = 0; c < static_cast<Index>(table.segment[anchor].cables); ++c, ++cable) {
      const double phase_rad = table.segment[anchor].cable_phase_rad[c];
      const double radius_m = table.segment[anchor].hole_radius_m;
      const double y_m = radius_m * std::cos(phase_rad), z_m = radius_m * std::sin(phase_rad);
      for (Index m = first; m <= anchor; ++m) {
        const SegmentParams& segment = table.segment[m];
        const Gap gap = gap_of(turns[m], segment.face_offset_m, y_m, z_m);
        const auto pitch = static_cast<Eigen::Index>(2 * m);
        double inside_links_m =
            (segment.modules - (m == anchor ? 1 : 0)) * (segment.module_length_m - 2.0 * segment.face_offset_m);
        // The last link ends with a disc of the next segment.
        if (m < anchor) inside_links_m += segment.face_offset_m - table.segment[m + 1].face_offset_m;
        paths.jacobian_m_rad(cable, pitch) = segment.modules * gap.by_pitch_m;
        paths.jacobian_m_rad(cable, pitch + 1) = segment.modules * gap.by_yaw_m;
        paths.stiffness_N_per_m[cable] += segment.modules * gap.length_m + inside_links_m;
        const double wrap_rad = segment.modules * gap.wrap_rad;
        paths.wrap_to_rad(cable, pitch) = paths.wrap_to_rad(cable, pitch + 1) = paths.wrap_rad[cable] + 0.5 * wrap_rad;
        paths.wrap_rad[cable] += wrap_rad;
      }
    }
  }
  paths.stiffness_N_per_m = table.cable_EA_N * paths.stiffness_N_per_m.cwiseInverse();
  if (feed_count != 0) {
    paths.jacobian_m_rad(0, 0) = table.segment[0].slide_m_rad;
    paths.jacobian_m_rad(1, 1) = table.segment[0].roll_radius_m;
    paths.stiffness_N_per_m.head(paths.feed_count).setConstant(kFeedStiffness_N_per_m);
  }
  return paths;
}

CableColumn balanced_tensions(const CablePaths& paths, const CableColumn& wanted_N, double floor_N,
                              const eigen::ThetaColumn& load_Nm) {
  const CableMatrix& jacobian = paths.jacobian_m_rad;
  const eigen::ThetaMatrix normal = jacobian.transpose().lazyProduct(jacobian);
  const Eigen::LLT<eigen::ThetaMatrix> solver(normal);
  CableColumn tension_N = wanted_N;
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    const eigen::ThetaColumn torque = load_Nm + jacobian.transpose().lazyProduct(tension_N);
    tension_N -= jacobian.lazyProduct(eigen::ThetaColumn(solver.solve(torque)));
    auto cables_N = tension_N.tail(tension_N.size() - paths.feed_count);
    if (cables_N.minCoeff() >= floor_N - kFloorRounding_N) break;
    if (turn + 1 < kMaxTurns) cables_N = cables_N.cwiseMax(floor_N + 1.0);
  }
  return tension_N;
}

eigen::ThetaColumn friction_torque(const ArmModel& model, const CablePaths& paths, const CableColumn& tension_N) {
  const double spread = model.friction_band * model.table.friction_mu;
  const auto share = (spread * paths.wrap_to_rad).array().exp() - 1.0;
  const CableMatrix torque = (paths.jacobian_m_rad.array().abs() * share).matrix();
  return torque.transpose().lazyProduct(tension_N.cwiseMax(0.0));
}

}  // namespace liana::simulation
