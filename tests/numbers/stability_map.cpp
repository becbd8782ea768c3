#include "tests/numbers/stability_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "tests/host/operator/haptics/bilateral_rig.hpp"

namespace liana::numbers {
namespace {

using namespace haptics;

constexpr double kJitter = 0.2;
constexpr double kThere_s = 4.0, kPress_s = 2.0, kWithdraw_s = 7.0, kOut_s = 9.0;
constexpr double kFirst_s = rig::kReachEnd_s + 2.0, kLast_s = kFirst_s + 15.0, kEnd_s = kLast_s + 15.0;

rig::RigTable table_of(Law law, Layer layer, const Cell& cell, std::uint64_t seed) {
  rig::RigTable table;
  table.loop.law = law;
  if (layer == Layer::kNone) table.loop.tank.start_J = table.loop.tank.most_J = std::numeric_limits<double>::infinity();
  if (layer != Layer::kTankAndDamping) table.loop.damping_N_s_m = 0.0;
  table.hand.mass_kg = cell.hand_kg;
  table.hand.stiffness_N_m = cell.hand_N_m;
  table.hand.tremor_m = 0.0;  // a trembling hand never stands still
  table.link = {cell.delay_s / 2.0, kJitter, 0.0};
  table.wall_N_m = cell.wall_N_m;
  table.seed = seed;
  return table;
}

// Mean squares over the parts of the reach.
void feel(double t_s, const HandForce& force, Verdict& verdict) {
  const double asked_N = force.passed > 0.0 ? norm(force.force_N) / force.passed : norm(force.law_N);
  const double taken2 = (1.0 - force.passed) * (1.0 - force.passed) * asked_N * asked_N * kTick_s;
  if (t_s < kThere_s) verdict.drag_N += norm(force.law_N) * kTick_s / kThere_s;
  if (t_s >= kPress_s && t_s < kWithdraw_s) verdict.taken_pressing_N += taken2 / (kWithdraw_s - kPress_s);
  if (t_s >= kWithdraw_s && t_s < kOut_s) verdict.taken_withdrawing_N += taken2 / (kOut_s - kWithdraw_s);
  if (t_s >= kWithdraw_s - 1.0 && t_s < kWithdraw_s) verdict.held_N -= force.force_N[1] * kTick_s;
}

}  // namespace

std::vector<Cell> cells() {
  std::vector<Cell> all;
  for (const double delay : kDelays_s)
    for (const double hand : kHands_N_m)
      for (const double mass : kMasses_kg)
        for (const double wall : kWalls_N_m) all.push_back({mass, hand, wall, delay});
  return all;
}

Verdict judge(Law law, Layer layer, const Cell& cell, std::uint64_t seed) {
  rig::BilateralRig rig(table_of(law, layer, cell, seed));
  Verdict verdict;
  std::optional<Vec3> began_m;
  while (rig.now_s() < kEnd_s) {
    const double t_s = rig.now_s();
    rig.step(rig::reach_intent(t_s));
    const Motion& hand = rig.omega().truth();
    const double speed = norm(hand.velocity_m_s);
    if (t_s >= kFirst_s && t_s < kLast_s) verdict.before_m_s = std::max(verdict.before_m_s, speed);
    if (t_s >= kLast_s) verdict.speed_m_s = std::max(verdict.speed_m_s, speed);
    if (t_s >= kLast_s && !began_m) began_m = hand.position_m;
    verdict.least_J = std::min(verdict.least_J, rig.omega().absorbed_J());
    feel(t_s, rig.force(), verdict);
  }
  verdict.drift_m = norm(subtract(rig.omega().truth().position_m, began_m.value_or(Vec3{})));
  verdict.taken_pressing_N = std::sqrt(verdict.taken_pressing_N);
  verdict.taken_withdrawing_N = std::sqrt(verdict.taken_withdrawing_N);
  return verdict;
}

}  // namespace liana::numbers
