// A kinematic stand-in for daemon, arm and camera: clutch mapping, first-order lag, a constant offset, late and noisy
// pictures.
#pragma once

#include <deque>
#include <optional>

#include "host/api/device/sample.hpp"
#include "host/base/random/random.hpp"
#include "host/operator/simulated/hand_grip.hpp"
#include "host/operator/simulated/slit_view.hpp"

namespace liana::test {

struct SoftTipConfig {
  double lag_s = 0.4;
  Vec3 offset_m{0.0, 0.0, 0.0};    // base frame; the tip is this far from where it is sent
  Vec3 offset_rad{0.0, 0.0, 0.0};  // base frame
  double noise_m = 0.0003;
  double noise_rad = 0.00087;
  double camera_latency_s = 0.1;
  double swing_hz = 0.0;       // 0: the tip goes where it is sent; else it swings about there
  double swing_damping = 0.1;  // share of critical
  std::uint64_t seed = 1;
};

class SoftTip {
 public:
  SoftTip(const simulated::SlitModel& drawing, const Pose& tip_in_base, const simulated::HandMapping& mapping,
          const SoftTipConfig& config)
      : drawing_(drawing),
        sent_(tip_in_base),
        goal_(tip_in_base),
        mapping_(mapping),
        config_(config),
        noise_(config.seed, 99),
        before_m_(tip_in_base.position_m) {}

  // One millisecond with this hand sample.
  void step(const device::Sample& hand, double dt_s) {
    if (hand.deadman && !engaged_) {
      hand_anchor_ = hand.pose;
      tip_anchor_ = sent_;
    }
    if (!hand.deadman && engaged_) goal_ = sent_;
    engaged_ = hand.deadman;
    if (engaged_) {
      const simulated::PoseStep step = simulated::step_between(hand_anchor_, hand.pose);
      goal_ = simulated::moved(tip_anchor_,
                               {scale(step.shift_m, mapping_.scale), scale(step.turn_rad, mapping_.rotation_scale)});
    }
    const simulated::PoseStep behind = simulated::step_between(sent_, goal_);
    sent_ = simulated::moved(
        sent_, {scale(behind.shift_m, dt_s / config_.lag_s), scale(behind.turn_rad, dt_s / config_.lag_s)});
    swing(dt_s);
  }

  // Takes a picture now and hands out one that is old enough.
  std::optional<simulated::TipObservation> picture(double now_s) {
    const Pose tip = true_tip();
    const Pose rod = compose(drawing_.slit_in_base, drawing_.rod_in_slit);
    pictures_.push_back(
        {now_s, {noisy(compose(inverse(tip), drawing_.slit_in_base)), noisy(compose(inverse(tip), rod))}});
    if (pictures_.front().taken_s + config_.camera_latency_s > now_s) return std::nullopt;
    const simulated::TipObservation sighting = pictures_.front().sighting;
    pictures_.pop_front();
    return sighting;
  }

  Pose true_tip() const { return simulated::moved(sent_, {add(config_.offset_m, swing_m_), config_.offset_rad}); }
  Pose true_tip_in_slit() const { return compose(inverse(drawing_.slit_in_base), true_tip()); }
  bool engaged() const { return engaged_; }
  void set_offset(const Vec3& offset_m) { config_.offset_m = offset_m; }

 private:
  // Second-order swing of the tip about where it is sent, semi-implicit.
  void swing(double dt_s) {
    if (config_.swing_hz <= 0.0) return;
    const double omega = 2.0 * 3.14159265358979 * config_.swing_hz;
    swing_m_ = subtract(swing_m_, subtract(sent_.position_m, before_m_));
    before_m_ = sent_.position_m;
    const Vec3 pull =
        add(scale(swing_m_, -omega * omega), scale(swing_speed_m_s_, -2.0 * config_.swing_damping * omega));
    swing_speed_m_s_ = add(swing_speed_m_s_, scale(pull, dt_s));
    swing_m_ = add(swing_m_, scale(swing_speed_m_s_, dt_s));
  }

  struct Picture {
    double taken_s;
    simulated::TipObservation sighting;
  };

  Pose noisy(const Pose& pose) {
    const auto axis = [&](double sigma) {
      return Vec3{noise_.normal(sigma), noise_.normal(sigma), noise_.normal(sigma)};
    };
    return simulated::moved(pose, {axis(config_.noise_m), axis(config_.noise_rad)});
  }

  simulated::SlitModel drawing_;
  Pose sent_;
  Pose goal_;
  Pose hand_anchor_{};
  Pose tip_anchor_{};
  simulated::HandMapping mapping_;
  SoftTipConfig config_;
  simulated::RandomStream noise_;
  bool engaged_ = false;
  Vec3 before_m_{};         // sent position one step ago
  Vec3 swing_m_{};          // tip less where it is sent
  Vec3 swing_speed_m_s_{};  // of the tip
  std::deque<Picture> pictures_;
};

}  // namespace liana::test
