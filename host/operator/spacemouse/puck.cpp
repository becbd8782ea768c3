#include "host/operator/spacemouse/puck.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace liana::spacemouse {

namespace {

// 0 within the dead counts, and from there on evenly to 1.
double share(const PuckTable& table, int counts) {
  const int beyond = std::abs(counts) - table.dead;
  if (beyond <= 0) return 0.0;
  return std::copysign(std::min(1.0, static_cast<double>(beyond) / (table.full - table.dead)), counts);
}

}  // namespace

// As libspnav moves an object: x right, y up, z away from the person, turns right-handed about each.
device::Twist twist_of(const PuckTable& table, const Deflection& d) {
  const auto at = [&](std::size_t axis) { return share(table, d[axis]); };
  return {scale({at(2), -at(0), at(1)}, table.speed_m_s), scale({at(5), -at(3), at(4)}, table.turn_rad_s)};
}

void Puck::push(const Deflection& deflection) {
  is_told_ = true;
  is_new_ = is_new_ || deflection != deflection_;
  deflection_ = deflection;
  if (!is_moved() && table_.button < 0) is_stale_ = false;
}

void Puck::lose() {
  is_stale_ = is_stale_ || (table_.button >= 0 ? buttons_ != 0 : is_moved());
  deflection_ = {};
  buttons_ = 0;
}

void Puck::press(int number, bool is_pressed) {
  if (number < 0 || number >= 32) return;  // a sample has room for so many
  const std::uint32_t bit = 1u << number;
  buttons_ = is_pressed ? buttons_ | bit : buttons_ & ~bit;
  if (number == table_.button) is_stale_ = false;
}

bool Puck::is_moved() const {
  return std::any_of(deflection_.begin(), deflection_.end(), [this](int d) { return share(table_, d) != 0.0; });
}

// A puck at rest says nothing, and is at rest for ever.
void Puck::grow_old(double step_s) {
  const bool is_told = std::exchange(is_told_, false), is_new = std::exchange(is_new_, false);
  if (!is_moved()) {
    silent_s_ = same_s_ = varies_s_ = 0.0;
    return;
  }
  silent_s_ = is_told ? 0.0 : silent_s_ + step_s;
  same_s_ = is_new ? 0.0 : same_s_ + step_s;
  const bool varied = varies_s_ >= kPuckVaries_s;
  varies_s_ = varied || !is_told || is_new ? varies_s_ + step_s : 0.0;
  if (silent_s_ > kPuckSilent_s || same_s_ > (varied ? kPuckSilent_s : kPuckSteady_s)) is_stale_ = true;
}

device::Sample Puck::step(std::int64_t t_us, double step_s) {
  grow_old(step_s);
  rests_s_ = is_stale_ ? 1e9 : is_moved() ? 0.0 : rests_s_ + step_s;
  device::Sample sample{.t_us = t_us, .stale = is_stale_, .buttons = buttons_};
  const bool is_held = table_.button >= 0 ? (buttons_ >> table_.button & 1u) != 0 : rests_s_ <= table_.let_go_s;
  sample.deadman = is_held && !is_stale_;
  if (sample.deadman) {
    sample.twist = twist_of(table_, deflection_);
    const Quat turn = quaternion_of(scale(sample.twist.angular_rad_s, step_s));
    pose_ = {add(pose_.position_m, scale(sample.twist.linear_m_s, step_s)),
             normalize(multiply(turn, pose_.quaternion))};
    for (double& x : pose_.position_m) x = std::clamp(x, -9.0, 9.0);  // a device's room is 10 m
  } else {
    pose_ = Pose{};
  }
  sample.pose = pose_;
  return sample;
}

}  // namespace liana::spacemouse
