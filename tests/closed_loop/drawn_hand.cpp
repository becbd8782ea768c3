#include "drawn_hand.hpp"

#include <algorithm>
#include <cmath>

namespace liana::closed_loop {

namespace {
constexpr double kStep_s = 1e-3;
constexpr std::array kNames = {"wave", "chirp", "steps", "walk"};
}  // namespace

// splitmix64
double DrawnHand::uniform() {
  std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
  return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

DrawnHand::DrawnHand(std::uint64_t seed, const HandBounds& bounds) : state_(seed * 0x2545F4914F6CDD1DULL + 1) {
  for (int i = 0; i < 4; ++i) uniform();
  kind_ = static_cast<HandKind>(static_cast<int>(4.0 * uniform()));
  name_ = kNames[static_cast<std::size_t>(kind_)];
  const int count = 1 + static_cast<int>(2.999 * uniform() * uniform());
  for (int i = 0; i < count; ++i) {
    const auto axis = static_cast<std::size_t>(6.0 * uniform());
    if (std::ranges::any_of(channels_, [axis](const auto& c) { return c.first == axis; })) continue;
    const bool turns = axis >= 3;
    Channel c;
    c.max_speed = (0.15 + 0.85 * uniform()) * (turns ? bounds.rate_rad_s : bounds.speed_m_s);
    c.max_accel = (0.1 + 0.9 * uniform()) * (turns ? bounds.accel_rad_s2 : bounds.accel_m_s2);
    c.max_way = (0.2 + 0.8 * uniform()) * (turns ? bounds.turn_rad : bounds.way_m);
    c.period_s = 0.6 + 4.0 * uniform();
    c.chirp = 0.05 + 0.3 * uniform();
    name_ += " " + std::to_string(axis);
    channels_.emplace_back(axis, c);
  }
}

double DrawnHand::target(Channel& c, double time_s) {
  switch (kind_) {
    case HandKind::kWave: {
      const double period_s = std::max(c.period_s, 4.0 * c.max_way / c.max_speed);
      return std::sin(2.0 * 3.14159265358979 * time_s / period_s) > 0.0 ? c.max_way : -c.max_way;
    }
    case HandKind::kChirp:
      return c.max_way * std::sin(2.0 * 3.14159265358979 * (0.1 + 0.5 * c.chirp * time_s) * time_s);
    case HandKind::kSteps:
      if (time_s >= c.until_s) {
        c.until_s = time_s + 0.3 + 2.0 * uniform();
        c.target = c.max_way * (2.0 * uniform() - 1.0);
      }
      return c.target;
    case HandKind::kWalk:
      if (time_s >= c.until_s) {
        c.until_s = time_s + 0.1 + 0.4 * uniform();
        c.target = std::clamp(c.target + 0.6 * c.max_way * (2.0 * uniform() - 1.0), -c.max_way, c.max_way);
      }
      return c.target;
  }
  return 0.0;
}

void DrawnHand::advance(Channel& c, double time_s, double step_s) {
  const double error = target(c, time_s) - c.value;
  const double stopping = std::sqrt(2.0 * 0.9 * c.max_accel * std::fabs(error));
  const double wanted = std::copysign(std::min(c.max_speed, stopping), error);
  c.rate += std::clamp(wanted - c.rate, -c.max_accel * step_s, c.max_accel * step_s);
  c.value += c.rate * step_s;
}

Pose DrawnHand::at(double time_s) {
  for (; time_s_ + kStep_s <= time_s; time_s_ += kStep_s) {
    for (auto& [axis, channel] : channels_) advance(channel, time_s_, kStep_s);
  }
  Pose pose;
  Vec3 turn{};
  for (const auto& [axis, channel] : channels_) (axis < 3 ? pose.position_m[axis] : turn[axis - 3]) = channel.value;
  pose.quaternion = quaternion_of(turn);
  return pose;
}

}  // namespace liana::closed_loop
