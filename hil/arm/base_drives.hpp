// What slide and roll of a base are moved by: a rack and a belt, stiff and well damped, between drive and carriage.
#pragma once

#include <array>
#include <optional>

#include "hil/config/robot_config.hpp"
#include "hil/math/reduced.hpp"

namespace liana::bench {

// Drive 0 moves the slide, drive 1 the roll; none without a base. As for cables the drive holds a "payout": counts as
// metres at the drum's radius, the path at the zero pose and the lead included. Its force is positive where the
// carriage is ahead of the drive, which then pulls as a cable's drum does; it may have either sign, for nothing goes
// slack.
class BaseDrives {
 public:
  // Of rack or belt, at the pitch line. Assumed: a steel-cored belt of 10 mm (0.6 MN per unit of strain) over 0.3 m
  // gives 2 MN/m a strand. 20 N of weight move the slide by 0.01 mm; a drive that sees only its motor can not see that.
  static constexpr double kStiffness_N_per_m = 2e6;

  // Of what holds a jammed slide, at the pitch line. Assumed: a bracket that gives 1 mm at 50 N.
  static constexpr double kJam_N_per_m = 5e4;

  explicit BaseDrives(const RobotConfig& robot);

  std::size_t count() const { return count_; }
  // Payout of a drive that holds nothing with the carriage at this angle, and the other way round.
  double payout_m(std::size_t drive, double angle_rad) const { return zero_m_[drive] + metres_[drive] * angle_rad; }
  double angle_rad(std::size_t drive, double payout_m) const { return (payout_m - zero_m_[drive]) / metres_[drive]; }

  // At rest at these angles, with what the weight asks of them (Chain::bias): the drives carry it.
  void carry(const Theta& theta_rad, const Theta& weight_Nm);
  // A step of the drives to `payout_m`, from the drives as they stand. Adds their force on the angles before the step
  // and their damping, both implicit, so that steps of any length are stable: critical damping at this inertia.
  void add(const Theta& theta_rad, const ThetaMatrix& mass, const CableValues& payout_m, double step_s, Theta& force,
           ThetaMatrix& damping);
  // The forces where the arm has come to.
  void settle(const Theta& theta_rad, const Theta& rate_rad_s);
  // Whether something holds what a drive moves, where it stands now.
  void set_jammed(std::size_t drive, bool jammed, const Theta& theta_rad);
  // The drives stand still where they are.
  void halt() { speed_m_s_ = {}; }

  double payout_m(std::size_t drive) const { return payout_m_[drive]; }
  double force_N(std::size_t drive) const { return force_N_[drive]; }
  // Elastic energy stored [J].
  double energy_J() const;

 private:
  using Values = std::array<double, kBaseDrives>;
  std::size_t count_;
  Values metres_{};  // per angle
  Values zero_m_{};  // payout at angle 0
  Values payout_m_{};
  Values speed_m_s_{};
  Values damping_Ns_per_m_{};
  Values stretch_m_{};
  Values force_N_{};
  std::array<std::optional<double>, kBaseDrives> jammed_rad_{};  // where; empty: free
};

}  // namespace liana::bench
