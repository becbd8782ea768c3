#include "tests/host/operator/haptics/bilateral_rig.hpp"

#include <algorithm>
#include <cmath>

namespace liana::haptics::rig {
namespace {

constexpr FilterBounds kShipped{0.10, 0.14, 0.7};  // lua/robots/zhu2022.lua
constexpr double kTip_kg = 0.4;
constexpr double kTip_N_m = 40.0;
constexpr double kTip_N_s_m = 1.6;  // assumed: a fifth of critical
constexpr double kWallLoss = 0.1;   // assumed: damping ratio of the tip on a wall
constexpr int kParts = 4;
constexpr std::int64_t kPacket_us = 20000;
constexpr Vec3 kStart{0.0, -0.05, 0.0};
constexpr double kReach_m = 0.10;

double minimum_jerk(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  return s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
}

}  // namespace

SoftArm::SoftArm(const Vec3& start_m, double wall_m, double wall_N_m)
    : filtered_m_(start_m), tip_{start_m, {}}, wall_m_(wall_m), wall_N_m_(wall_N_m) {}

void SoftArm::step(const Vec3& command_m) {
  follow_channel(kShipped, kTick_s, subtract(command_m, filtered_m_), filter_);
  filtered_m_ = add(filtered_m_, scale(filter_.velocity, kTick_s));
  const double wall_N_s_m = 2.0 * kWallLoss * std::sqrt(wall_N_m_ * kTip_kg);
  for (int part = 0; part < kParts; ++part) {
    Vec3 force = add(scale(subtract(filtered_m_, tip_.position_m), kTip_N_m),
                     scale(subtract(filter_.velocity, tip_.velocity_m_s), kTip_N_s_m));
    const double depth_m = tip_.position_m[1] - wall_m_;
    if (depth_m > 0.0) force[1] -= std::max(0.0, wall_N_m_ * depth_m + wall_N_s_m * tip_.velocity_m_s[1]);
    tip_.velocity_m_s = add(tip_.velocity_m_s, scale(force, kTick_s / kParts / kTip_kg));
    tip_.position_m = add(tip_.position_m, scale(tip_.velocity_m_s, kTick_s / kParts));
  }
}

Intent reach_intent(double t_s) {
  const double share = t_s < 7.0 ? minimum_jerk(t_s / 4.0) : 1.0 - minimum_jerk((t_s - 7.0) / 4.0);
  return {add(kStart, {0.0, kReach_m * share, 0.0}), {}, true};
}

BilateralRig::BilateralRig(const RigTable& table)
    : omega_(OmegaTable{}, table.hand, kStart, table.seed),
      loop_(table.loop),
      forward_(table.link, table.seed, 41),
      back_(table.link, table.seed, 42),
      arm_(kStart, 0.0, table.wall_N_m),
      predicted_(kStart, 0.0, 0.0),
      sent_m_(kStart) {}

void BilateralRig::change_link(const LinkTable& table) {
  forward_.change(table);
  back_.change(table);
}

// Every 20 ms both ends speak; what has come is heard at once.
void BilateralRig::exchange(const Vec3& hand_m) {
  if (now_us_ % kPacket_us == 0) {
    sent_m_ = hand_m;
    forward_.send({sequence_, now_us_, hand_m}, now_us_);
    const bool any = applied_since_us_ >= 0;
    back_.send({sequence_, any ? applied_.sent_us : -1, any ? now_us_ - applied_since_us_ : 0, arm_.tip()}, now_us_);
    loop_.predict(now_us_, predicted_.tip());
    ++sequence_;
  }
  while (const auto command = forward_.receive(now_us_)) {
    if (!newest_command_.accept(command->sequence)) continue;
    applied_ = *command;
    applied_since_us_ = now_us_;
  }
  while (const auto state = back_.receive(now_us_)) loop_.take(*state);
}

void BilateralRig::advance_arm() {
  predicted_.step(sent_m_);
  arm_.step(applied_since_us_ < 0 ? kStart : applied_.position_m);
}

void BilateralRig::step(const Intent& intent) {
  const auto sample = omega_.sample();
  exchange(sample.pose.position_m);
  force_ = loop_.step(sample, sample.pose.position_m);
  omega_.step(force_.force_N, intent);
  advance_arm();
  now_us_ += kTick_us;
}

}  // namespace liana::haptics::rig
