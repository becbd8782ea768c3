#include "host/spacemouse/puck.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

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

void Puck::press(int number, bool is_pressed) {
  if (number < 0 || number >= 32) return;  // a sample has room for so many
  const std::uint32_t bit = 1u << number;
  buttons_ = is_pressed ? buttons_ | bit : buttons_ & ~bit;
}

bool Puck::is_moved() const {
  return std::any_of(deflection_.begin(), deflection_.end(), [this](int d) { return share(table_, d) != 0.0; });
}

device::Sample Puck::step(std::int64_t t_us, double step_s) {
  rests_s_ = is_moved() ? 0.0 : rests_s_ + step_s;
  device::Sample sample{.t_us = t_us, .buttons = buttons_};
  sample.deadman = table_.button >= 0 ? (buttons_ >> table_.button & 1u) != 0 : rests_s_ <= table_.let_go_s;
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
