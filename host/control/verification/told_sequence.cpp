#include "host/control/verification/told_sequence.hpp"

#include <algorithm>

#include "host/control/arbiter/cable_traits.hpp"

namespace liana::verification {

namespace {

using cable::CableArm;

template <class Vector>
Vector between(const Vector& from, const Vector& to, double share) {
  Vector out = from;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += share * (to[i] - from[i]);
  return out;
}

}  // namespace

simulation::ToldNow told_now(const cable::RobotParams& table, const cable::Outputs& now) {
  const Eigen::Index thetas = eigen::theta_count(table);
  return {eigen::view(now.theta_command_rad, thetas), eigen::view(now.load_Nm, thetas),
          Eigen::Map<const simulation::CableColumn>(now.tension_plan_N.data(), table.cable_count())};
}

template <class Arm>
void read_sequence(const TwinSnapshot<Arm>& image, std::uint64_t first_tick, const Prediction<Arm>& prediction,
                   simulation::ToldRows<arbiter::Joints<Arm>>& out) {
  using Kind = arbiter::ArmTraits<Arm>;
  const auto& table = image.controller.table();
  const auto interval = static_cast<std::size_t>(table.interval_ticks);
  const std::size_t last = prediction.ticks.size() - 1;
  out.interval_s = static_cast<double>(interval) * table.tick_s;
  out.rows_rad.clear();
  const auto& now = Kind::command_rad(image.last_outputs);
  out.rows_rad.push_back(now);
  // Until the candidate's first tick the drives are told what was released before: straight to where that begins.
  const auto rows = (first_tick - image.next_tick) / interval;
  for (std::uint64_t row = 1; row <= rows; ++row) {
    const double share = static_cast<double>(row * interval) / static_cast<double>(rows * interval + 1);
    out.rows_rad.push_back(arbiter::between(now, Kind::command_rad(prediction.ticks.front()), share));
  }
  for (std::size_t tick = interval - 1; tick < last + interval; tick += interval)
    out.rows_rad.push_back(Kind::command_rad(prediction.ticks[std::min(tick, last)]));
}

#define LIANA_READ_SEQUENCE(Arm)                                                                    \
  template void read_sequence<Arm>(const TwinSnapshot<Arm>&, std::uint64_t, const Prediction<Arm>&, \
                                   simulation::ToldRows<arbiter::Joints<Arm>>&)
LIANA_READ_SEQUENCE(cable::CableArm);
LIANA_READ_SEQUENCE(serial::SerialArm);
#undef LIANA_READ_SEQUENCE

void read_sequence(const TwinSnapshot<CableArm>& image, std::uint64_t first_tick,
                   const Prediction<CableArm>& prediction, simulation::JointSequence& out) {
  read_sequence<CableArm>(image, first_tick, prediction, out);
  const auto interval = static_cast<std::size_t>(image.controller.table().interval_ticks);
  const std::size_t last = prediction.ticks.size() - 1;
  const cable::Outputs &now = image.last_outputs, &begins = prediction.ticks.front();
  out.loads_Nm.assign(1, now.load_Nm);
  out.tensions_N.assign(1, now.tension_plan_N);
  const auto rows = (first_tick - image.next_tick) / interval;
  for (std::uint64_t row = 1; row <= rows; ++row) {
    const double share = static_cast<double>(row * interval) / static_cast<double>(rows * interval + 1);
    out.loads_Nm.push_back(between(now.load_Nm, begins.load_Nm, share));
    out.tensions_N.push_back(between(now.tension_plan_N, begins.tension_plan_N, share));
  }
  for (std::size_t tick = interval - 1; tick < last + interval; tick += interval) {
    const cable::Outputs& told = prediction.ticks[std::min(tick, last)];
    out.loads_Nm.push_back(told.load_Nm);
    out.tensions_N.push_back(told.tension_plan_N);
  }
}

}  // namespace liana::verification
