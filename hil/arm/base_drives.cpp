#include "hil/arm/base_drives.hpp"

#include <cmath>

namespace liana::bench {

BaseDrives::BaseDrives(const RobotConfig& robot) : count_(robot.base_drives()) {
  if (count_ == 0) return;
  metres_ = robot.base->metres_per_rad();
  const std::vector<double> paths_m = robot.paths_at_zero_m();
  for (std::size_t i = 0; i < count_; ++i) zero_m_[i] = paths_m[i] + robot.lead_m;
}

void BaseDrives::carry(const Theta& theta_rad, const Theta& weight_Nm) {
  for (std::size_t i = 0; i < count_; ++i)
    payout_m_[i] = payout_m(i, theta_rad[i]) + weight_Nm[i] / metres_[i] / kStiffness_N_per_m;
  settle(theta_rad, Theta{});
}

void BaseDrives::add(const Theta& theta_rad, const ThetaMatrix& mass, const CableValues& payout_m, double step_s,
                     Theta& force, ThetaMatrix& damping) {
  for (std::size_t i = 0; i < count_; ++i) {
    speed_m_s_[i] = (payout_m[i] - payout_m_[i]) / step_s;
    payout_m_[i] = payout_m[i];
    const double moved_kg = mass[i][i] / (metres_[i] * metres_[i]);
    damping_Ns_per_m_[i] = 2.0 * std::sqrt(kStiffness_N_per_m * moved_kg);
    const double stretch_m = this->payout_m(i, theta_rad[i]) - payout_m_[i];
    force[i] -= metres_[i] * (kStiffness_N_per_m * stretch_m - damping_Ns_per_m_[i] * speed_m_s_[i]);
    damping[i][i] += metres_[i] * metres_[i] * (damping_Ns_per_m_[i] + step_s * kStiffness_N_per_m);
    if (!jammed_rad_[i]) continue;
    force[i] -= metres_[i] * metres_[i] * kJam_N_per_m * (theta_rad[i] - *jammed_rad_[i]);
    damping[i][i] += metres_[i] * metres_[i] * step_s * kJam_N_per_m;
  }
}

void BaseDrives::set_jammed(std::size_t drive, bool jammed, const Theta& theta_rad) {
  if (!jammed) {
    jammed_rad_[drive].reset();
  } else if (!jammed_rad_[drive]) {
    jammed_rad_[drive] = theta_rad[drive];
  }
}

void BaseDrives::settle(const Theta& theta_rad, const Theta& rate_rad_s) {
  for (std::size_t i = 0; i < count_; ++i) {
    stretch_m_[i] = payout_m(i, theta_rad[i]) - payout_m_[i];
    force_N_[i] =
        kStiffness_N_per_m * stretch_m_[i] + damping_Ns_per_m_[i] * (metres_[i] * rate_rad_s[i] - speed_m_s_[i]);
  }
}

double BaseDrives::energy_J() const {
  double energy = 0.0;
  for (const double stretch_m : stretch_m_) energy += 0.5 * kStiffness_N_per_m * stretch_m * stretch_m;
  return energy;
}

}  // namespace liana::bench
