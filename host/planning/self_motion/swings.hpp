// With which periods serial arms swing, one on the other, while their drives hold.
#pragma once

#include <span>
#include <vector>

#include "firmware_like/serial/joint_vector.hpp"
#include "firmware_like/serial/mass_table.hpp"
#include "firmware_like/serial/robot_params.hpp"

namespace liana::self_motion {

// An arm as it stands: its joints are springs about their axes.
struct SpringyArm {
  const serial::RobotParams& table;
  const serial::MassTable& masses;
  const serial::JointVector& joint_rad;
  const serial::JointVector& stiffness_Nm_rad;  // each > 0
};

// Undamped periods [s], longest first, one for each joint of the chain. Each arm stands on the tip of the one before;
// `load` is fixed to the last tip, given in its frame. They are those of small swings, K x = w^2 M x, without gravity.
// Cost: about 200 us for two arms of seven joints.
std::vector<double> swing_periods_s(std::span<const SpringyArm> chain, const serial::LinkMass& load);

}  // namespace liana::self_motion
