#include "host/operator/station/tip_prediction.hpp"

#include "firmware_like/operator_input/tip_interval.hpp"

namespace liana::station {

TipPrediction::TipPrediction(const cable::RobotParams& table, const arbiter::SpeedZone& zone)
    : table_(table), zone_(zone), asked_m_s_(table.limits.tip_speed_m_s) {}

void TipPrediction::begin(const arbiter::DeviceUse& use, const Pose& tip_in_base) {
  steer_.use(use);
  asked_m_s_ = use.speed_m_s > 0.0 ? use.speed_m_s : table_.limits.tip_speed_m_s;
  stand_at(tip_in_base);
}

void TipPrediction::stand_at(const Pose& tip_in_base) {
  filter_ = {};
  filter_.pose = goal_ = tip_in_base;
}

void TipPrediction::add(const device::Sample& sample) { steer_.add(sample); }

void TipPrediction::finish_interval() {
  cable::Outputs now{};
  now.tip_command = filter_.pose;
  const auto goal = steer_.finish_interval(now, table_.tick_s * table_.interval_ticks);
  const Pose from = goal_;
  goal_ = goal ? goal->tip_in_base : filter_.pose;
  advance(goal ? from : filter_.pose, goal_, goal.has_value());
}

void TipPrediction::advance(const Pose& from, const Pose& to, bool steered) {
  const double asked_m_s = zone_.advice_at(filter_.pose.position_m, zone_.advice_at(to.position_m, asked_m_s_));
  const TipFilterConfig config = cable::tip_filter_config(table_, asked_m_s);
  const Vec3 turn = rotation_vector(multiply(to.quaternion, conjugate(from.quaternion)));
  for (std::int32_t tick = 1; tick <= table_.interval_ticks; ++tick) {
    const double share = interval_share(tick, table_.interval_ticks);
    if (steered) {
      filter_tip(config, interpolated_pose(from, to, turn, share), filter_);
    } else {
      brake_tip(config, filter_);
    }
  }
}

}  // namespace liana::station
