#include "host/operator/haptics/haptic_loop.hpp"

#include <cmath>
#include <limits>

#include "host/operator/haptics/range.hpp"

namespace liana::haptics {
namespace {

void check(const HandLoopTable& table) {
  const auto within = [](const char* field, double value, double least, double most) {
    check_range("hand loop", field, value, least, most);
  };
  within("gains.stiffness_N_m", table.gains.stiffness_N_m, 0.0, 1000.0);
  within("gains.damping_N_s_m", table.gains.damping_N_s_m, 0.0, 20.0);
  within("gains.unsure_m", table.gains.unsure_m, 0.0, 0.1);
  within("gains.scale", table.gains.scale, 0.01, 100.0);
  within("tank.start_J", table.tank.start_J, 0.0, std::numeric_limits<double>::infinity());  // without end: no tank
  within("tank.most_J", table.tank.most_J, table.tank.start_J, std::numeric_limits<double>::infinity());
  within("tank.share", table.tank.share, 0.0, 0.5);
  within("force_N", table.force_N, 0.0, 100.0);
  within("law_N_s", table.law_N_s, 1.0, 1e6);
  within("damping_N_s_m", table.damping_N_s_m, 0.0, 20.0);
  within("fresh_s", table.fresh_s, 0.02, 10.0);
  within("fade_s", table.fade_s, 0.001, 10.0);
  within("velocity_s", table.velocity_s, kTick_s, 0.1);
}

}  // namespace

HapticLoop::HapticLoop(const HandLoopTable& table) : table_(table), tank_(table.tank) { check(table); }

bool HapticLoop::take(const StatePacket& packet) noexcept {
  if (!newest_.accept(packet.sequence)) return false;
  const auto then = packet.answers_us < 0 ? std::nullopt : predictions_.at(packet.answers_us + packet.held_us);
  heard_ = Heard{packet.tip, then.value_or(packet.tip), 0};
  return true;
}

void HapticLoop::feel_hand(const Vec3& position_m) noexcept {
  const Vec3 moved = begun_ ? subtract(position_m, hand_.position_m) : Vec3{};
  const double share = kTick_s / (table_.velocity_s + kTick_s);
  const Vec3 change = subtract(scale(moved, 1.0 / kTick_s), hand_.velocity_m_s);
  hand_ = {position_m, add(hand_.velocity_m_s, scale(change, share))};
  begun_ = true;
}

Vec3 HapticLoop::force_of_walls() noexcept {
  Vec3 sum{};
  for (MovingPlane& wall : walls_) {
    wall.advance();
    sum = add(sum, wall.force(hand_));
  }
  return sum;
}

double HapticLoop::freshness(bool engaged) const noexcept {
  if (!engaged || !heard_) return 0.0;
  const double age_s = 1e-6 * static_cast<double>(heard_->since_us);
  return age_s <= table_.fresh_s ? 1.0 : std::exp((table_.fresh_s - age_s) / table_.fade_s);
}

// No prediction, no force of the laws that need one.
Vec3 HapticLoop::wanted_of_arm(const Vec3& commanded_m) const noexcept {
  if (!heard_) return {};
  const Motion commanded{commanded_m, scale(hand_.velocity_m_s, table_.gains.scale)};
  const Motion now = predictions_.newest().value_or(heard_->tip);
  return law_force(table_.law, table_.gains, {heard_->tip, commanded, now, heard_->predicted_then});
}

const HandForce& HapticLoop::step(const device::Sample& sample, const Vec3& commanded_m) noexcept {
  if (sample.valid) feel_hand(sample.pose.position_m);
  if (heard_) heard_->since_us += kTick_us;
  out_.fresh = freshness(sample.valid && sample.deadman);
  const Vec3 wanted = no_longer(scale(wanted_of_arm(commanded_m), out_.fresh), table_.force_N);
  out_.law_N = add(out_.law_N, no_longer(subtract(wanted, out_.law_N), table_.law_N_s * kTick_s));
  out_.wall_N = force_of_walls();
  const Vec3 drag = scale(hand_.velocity_m_s, -table_.damping_N_s_m);
  const Vec3 sum = sample.valid ? add(add(out_.law_N, out_.wall_N), drag) : Vec3{};
  const Vec3 bounded = no_longer(sum, table_.force_N);
  out_.clamped = norm(sum) > table_.force_N;
  out_.force_N = tank_.pass(bounded, hand_.position_m);
  out_.store_J = tank_.store_J();
  out_.passed = tank_.passed();
  return out_;
}

}  // namespace liana::haptics
