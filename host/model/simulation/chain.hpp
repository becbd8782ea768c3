// Kinematics of the simulation: one universal joint after another, as the rows of the source say (mission, A1).
// It shares no code with the core's closed form, so that a mistake in one shows.
#pragma once

#include <Eigen/Core>
#include <array>

#include "host/base/eigen/thetas.hpp"
#include "host/model/simulation/arm_model.hpp"

namespace liana::simulation {

constexpr std::int32_t kMaxLinks = kMaxSegments * kMaxModules;

// Where every link is. Point 0 is the base, where it has been fed to, point i the end of link i; the last one is the
// tip. Base frame.
struct Chain {
  std::int32_t links = 0;
  std::array<Eigen::Vector3d, kMaxLinks + 1> point_m;
  std::array<Eigen::Matrix3d, kMaxLinks + 1> rotation;  // [i]: axes of link i as columns, [0] = base; x along the link

  const Eigen::Vector3d& tip_m() const { return point_m[static_cast<std::size_t>(links)]; }
};

// Places the links at these angles. About 4,000 instructions for 40 links.
void place(const ArmModel& model, const ThetaVector& theta_rad, Chain& chain);

// Reduced mass matrix [kg m2] of the placed links: for each link its mass at its centre and its inertia about it,
// for the tool its mass.
eigen::ThetaMatrix mass_matrix(const ArmModel& model, const Chain& chain);

// Torque [N m] about each theta that holds the placed links: their weight, the tool's, and the springs of the joints.
eigen::ThetaColumn static_load(const ArmModel& model, const ThetaVector& theta_rad, const Chain& chain);

}  // namespace liana::simulation
