#include "host/model/simulation/swinging_arm.hpp"

namespace liana::simulation {

namespace {

using eigen::ThetaColumn;
using eigen::view;

// Assumed, times the table's floor: where tensions are planned without measured ones.
constexpr double kPlannedFloor = 1.5;

double largest_change(const ThetaColumn& a, const ThetaVector& b) {
  return (a - view(b, a.size())).cwiseAbs().maxCoeff();
}

CableColumn planned_tensions(const ArmModel& model, const CablePaths& paths, const ThetaColumn& load_Nm) {
  const TensionLimits& limits = model.table.tension;
  return balanced_tensions(paths, CableColumn::Constant(paths.wrap_rad.size(), limits.plan_N),
                           kPlannedFloor * limits.floor_motor_N, load_Nm);
}

}  // namespace

bool SwingingArm::solve(const ThetaVector& about_rad) {
  about_rad_ = about_rad;
  ++times_solved_;
  return arm_.solve(model_, about_rad, step_s_);
}

CableColumn SwingingArm::modelled_N() const { return planned_.now() + arm_.stretch_N(swing_.theta_rad - theta_.now()); }

bool SwingingArm::begin(const StartState& start, const ToldNow& before, const ToldNow& now, double since_s,
                        double step_s) {
  const Eigen::Index thetas = eigen::theta_count(model_.table), cables = model_.table.cable_count();
  step_s_ = step_s;
  if (start.tip_load) model_.table.tool = *start.tip_load;
  if (!solve(start.theta_rad)) return false;
  const double tau_s = model_.table.servo_time_constant_s;
  theta_ = {tau_s, step_s, now.theta_rad, (now.theta_rad - before.theta_rad) / since_s};
  load_ = {tau_s, step_s, now.load_Nm, (now.load_Nm - before.load_Nm) / since_s};
  planned_ = {tau_s, step_s, now.tension_N, (now.tension_N - before.tension_N) / since_s};
  swing_.theta_rad = view(start.theta_rad, thetas);
  swing_.rate_rad_s = view(start.rate_rad_s, thetas);
  swing_.drums_rad = swing_.theta_rad + view(start.ahead_rad, thetas);
  const Eigen::Map<const CableColumn> measured_N(start.tension_N.data(), cables);
  beside_N_ = (measured_N.isZero() ? planned_.now() : CableColumn(measured_N)) - modelled_N();
  return true;
}

bool SwingingArm::step(const ToldNow& told) {
  const ThetaColumn theta_rad = theta_.now(), load_Nm = load_.now();
  theta_.step(told.theta_rad);
  load_.step(told.load_Nm);
  planned_.step(told.tension_N);
  const ThetaColumn turned_rad = theta_.now() - theta_rad;
  arm_.step(swing_.drums_rad + turned_rad + arm_.beyond_rad(load_.now() - load_Nm), turned_rad, swing_);
  return largest_change(swing_.theta_rad, about_rad_) <= kNewPose_rad || solve(vector(swing_.theta_rad));
}

void SwingingArm::correct(const ThetaColumn& theta_rad, const ThetaColumn& rate_rad_s, const ThetaColumn& held_rad) {
  swing_.theta_rad += theta_rad;
  swing_.rate_rad_s += rate_rad_s;
  swing_.drums_rad += held_rad;
}

JointSequence planned_with(const ArmModel& model, const ToldRows<ThetaVector>& rows) {
  const Eigen::Index thetas = eigen::theta_count(model.table), cables = model.table.cable_count();
  const auto row = [&](std::size_t i) { return view(rows.rows_rad[i], thetas); };
  JointSequence out{rows, {}, {}};
  for (std::size_t i = 0; i < rows.rows_rad.size(); ++i) {
    const bool ends = i == 0 || i + 1 == rows.rows_rad.size();  // what comes before and after is not known
    ThetaColumn change_rad = ThetaColumn::Zero(thetas);
    if (!ends) change_rad = row(i + 1) - 2.0 * row(i) + row(i - 1);
    Chain chain;
    place(model, rows.rows_rad[i], chain);
    const ThetaColumn load_Nm = static_load(model, rows.rows_rad[i], chain) +
                                mass_matrix(model, chain) * change_rad / (rows.interval_s * rows.interval_s);
    CableVector tension_N{};
    Eigen::Map<CableColumn>(tension_N.data(), cables) =
        planned_tensions(model, cable_paths(model, rows.rows_rad[i]), load_Nm);
    out.loads_Nm.push_back(vector(load_Nm));
    out.tensions_N.push_back(tension_N);
  }
  return out;
}

}  // namespace liana::simulation
