#include "hil/bench/drive_bank.hpp"

#include <utility>

namespace liana::bench {

namespace {

constexpr double kTorqueNoise = 0.003;  // of the reading

}  // namespace

DriveBank::DriveBank(const RobotConfig& robot, const BusesConfig& buses, const TrueParameters& truth,
                     const CableValues& payout_m, bool noisy, std::uint64_t seed,
                     const std::vector<std::size_t>& cross_wired)
    : Drives(robot.product, seed),
      robot_(robot),
      truth_(truth),
      path_at_zero_m_(robot.paths_at_zero_m()),
      creep_(robot.drive_count()),
      noisy_(noisy),
      torque_noise_(seed, "torque noise") {
  for (std::size_t i = 0; i < robot.drive_count(); ++i) cable_of_.push_back(i);
  if (cross_wired.size() == 2) std::swap(cable_of_[cross_wired[0]], cable_of_[cross_wired[1]]);
  for (std::size_t i = 0; i < robot.drive_count(); ++i) {
    const std::size_t cable = cable_of_[i];
    const double paid_out = payout_m[cable] - path_at_zero_m_[cable] - robot.lead_m - truth.zero_offset_m[cable];
    const double counts = robot.drives[i].zero_counts + robot.drives[i].direction * paid_out / robot.metres_per_count();
    add(drive_settings(robot, buses, i), counts);
  }
}

CableValues DriveBank::payouts_m() const {
  CableValues payout{};
  for (std::size_t i = 0; i < size(); ++i) {
    const double counts = drive(i).motor().position_counts() - robot_.drives[i].zero_counts;
    const std::size_t cable = cable_of_[i];
    payout[cable] = path_at_zero_m_[cable] + robot_.lead_m + truth_.zero_offset_m[cable] + loose_m_[i] +
                    robot_.drives[i].direction * counts * robot_.metres_per_count();
  }
  return payout;
}

double DriveBank::permille(double tension_N) const {
  return 1000.0 * tension_N * robot_.drum_radius_m / robot_.rated_torque_Nm;
}

void DriveBank::creep() {
  for (std::size_t i = 0; i < creep_.size(); ++i) {
    if (creep_[i].slots_left == 0) continue;
    loose_m_[i] += creep_[i].per_slot_m;
    --creep_[i].slots_left;
  }
}

void DriveBank::exchange(const FrameList& frames, std::uint64_t now_us, FrameList& out) {
  creep();
  Drives::exchange(frames, now_us, out);
}

void DriveBank::move(double step_s, const CableValues& tension_N) {
  for (std::size_t i = 0; i < size(); ++i) at(i).move(step_s, permille(tension_N[cable_of_[i]]));
}

void DriveBank::measure(const CableValues& tension_N) {
  for (std::size_t i = 0; i < size(); ++i) {
    const double noise = noisy_ ? 1.0 + torque_noise_.gaussian(kTorqueNoise) : 1.0;
    set_measured(i, permille(tension_N[cable_of_[i]]) * truth_.torque_gain[i] * noise);
  }
}

}  // namespace liana::bench
