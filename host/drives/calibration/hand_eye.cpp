#include "host/drives/calibration/hand_eye.hpp"

#include <Eigen/Dense>
#include <stdexcept>

namespace liana::calibration {
namespace {

using Matrix = Eigen::Matrix3d;

constexpr double kTurned = 1e-3;  // mean square of what tells the rotations apart: about 2 deg of turn

Matrix matrix(const Quat& q) { return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix(); }
Eigen::Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }
Vec3 vector(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

// The rotation next to a matrix that is one up to a factor.
Quat rotation(Matrix m) {
  if (m.determinant() < 0.0) m = -m;
  const Eigen::JacobiSVD<Matrix> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Quaterniond q(svd.matrixU() * svd.matrixV().transpose());
  return normalize({q.w(), q.x(), q.y(), q.z()});
}

}  // namespace

HandEye hand_eye(const std::vector<Pose>& tip_in_base, const std::vector<Pose>& marker_in_tracker) {
  const auto count = static_cast<Eigen::Index>(tip_in_base.size());
  // R_marker Z' = X R_tip, linear in the entries of X (base in tracker) and Z (marker in tip), each column by column.
  Eigen::Matrix<double, 18, 18> squares = Eigen::Matrix<double, 18, 18>::Zero();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Matrix seen = matrix(marker_in_tracker[static_cast<std::size_t>(i)].quaternion),
                 tip = matrix(tip_in_base[static_cast<std::size_t>(i)].quaternion);
    Eigen::Matrix<double, 9, 18> rows = Eigen::Matrix<double, 9, 18>::Zero();
    for (Eigen::Index c = 0; c < 3; ++c) {
      rows.block<3, 3>(3 * c, 3 * c) = seen;
      for (Eigen::Index k = 0; k < 3; ++k) rows.block<3, 3>(3 * c, 9 + 3 * k) = -tip(k, c) * Matrix::Identity();
    }
    squares += rows.transpose() * rows / static_cast<double>(count);
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 18, 18>> known(squares);
  if (!(known.eigenvalues()(1) > kTurned))
    throw std::runtime_error(
        "the poses turn the tip too little, or about one axis only: take poses that bend the arm up, down and to both "
        "sides");
  const Eigen::Matrix<double, 18, 1> both = known.eigenvectors().col(0);
  HandEye out;
  out.marker_in_tip.quaternion = conjugate(rotation(Eigen::Map<const Matrix>(both.data())));
  out.base_in_tracker.quaternion = rotation(Eigen::Map<const Matrix>(both.data() + 9));
  const Matrix base = matrix(out.base_in_tracker.quaternion);
  Eigen::MatrixXd rows(3 * count, 6);
  Eigen::VectorXd seen_m(3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Pose& tip = tip_in_base[static_cast<std::size_t>(i)];
    rows.block<3, 3>(3 * i, 0) = Matrix::Identity();
    rows.block<3, 3>(3 * i, 3) = base * matrix(tip.quaternion);
    seen_m.segment<3>(3 * i) =
        vector(marker_in_tracker[static_cast<std::size_t>(i)].position_m) - base * vector(tip.position_m);
  }
  const Eigen::VectorXd found_m = rows.colPivHouseholderQr().solve(seen_m);
  out.base_in_tracker.position_m = vector(Eigen::Vector3d(found_m.head<3>()));
  out.marker_in_tip.position_m = vector(Eigen::Vector3d(found_m.tail<3>()));
  return out;
}

}  // namespace liana::calibration
