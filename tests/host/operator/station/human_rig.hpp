// The human's whole session at an arm that is led (led_arm.hpp): what lianad would tell, the tip camera, and the steps
// of the slit crossing, without physics. The true tip is a little beside the commanded one.
#pragma once

#include <deque>

#include "firmware_like/math/trig.hpp"
#include "host/api/device/packets.hpp"
#include "host/base/random/random.hpp"
#include "host/operator/station/steering.hpp"
#include "tests/host/operator/simulated/led_arm.hpp"

namespace liana::test {

struct HumanRigTable {
  Vec3 beside_m{0.003, 0.003, -0.0026};  // true tip less commanded, base frame
  Vec3 turned_rad{0.003, -0.003, 0.003};
  double measured_share = 0.5;  // of that, which is measured
  std::uint64_t seed = 1;
};

class HumanRig {
 public:
  HumanRig(const HumanRigTable& table, const cable::RobotParams& robot, const cable::ThetaVector& theta_rad,
           const config::SceneConfig& scene, station::Steering& person)
      : table_(table),
        robot_(robot),
        scene_(scene),
        arm_(robot, theta_rad, arbiter::SpeedZone(scene.slit, robot.limits.tip_speed_slit_m_s)),
        person_(person),
        noise_(table.seed, 99) {}

  // A step by a device; until the person says that it is done, or `most_s` are over. True when they did.
  bool step(const char* device, const char* task, const arbiter::DeviceUse& use, double most_s) {
    arm_.use(use);
    step_ = {{"index", ++index_}, {"name", task}, {"device", device}, {"task", task}, {"entry", index_}};
    device_ = device;
    mapping_ = {{"scale", use.mapping.scale}, {"rotation_scale", use.mapping.rotation_scale}};
    const double until_s = now_s_ + most_s;
    for (said_ = false; !said_ && now_s_ < until_s;) interval();
    return said_;
  }
  // Variables go to 0, the tip where it is.
  void hold_at_zero(std::uint32_t mask) {
    step_ = {{"index", ++index_}, {"name", "hold"}, {"device", "none"}, {"task", ""}, {"entry", index_}};
    device_ = "none";
    arm_.use({});
    arm_.hold_at_zero(mask);
    for (int i = 0; i < 400; ++i) interval();
  }

  Pose true_tip() const { return simulated::moved(arm_.tip(), {table_.beside_m, table_.turned_rad}); }
  Pose true_tip_in_slit() const { return compose(inverse(slit()), true_tip()); }
  double now_s() const { return now_s_; }
  const LedArm& arm() const { return arm_; }
  // Farthest of the true tip from the slit's plane, past the mouth.
  double widest_in_slit_m() const { return widest_m_; }

 private:
  Pose slit() const { return {scene_.slit->frame.position_m, scene_.slit->frame.quaternion_wxyz}; }
  Pose rod() const { return {scene_.rod->pose.position_m, scene_.rod->pose.quaternion_wxyz}; }

  Pose measured_tip() const {
    return simulated::moved(
        arm_.tip(), {scale(table_.beside_m, table_.measured_share), scale(table_.turned_rad, table_.measured_share)});
  }
  static Json numbers(const Pose& pose) {
    Json list = Json::array();
    for (double x : pose.position_m) list.push_back(x);
    for (double q : pose.quaternion) list.push_back(q);
    return list;
  }
  Json seen(const Pose& what) {
    const auto axis = [&](double sigma) {
      return Vec3{noise_.normal(sigma), noise_.normal(sigma), noise_.normal(sigma)};
    };
    return numbers(simulated::moved(compose(inverse(true_tip()), what), {axis(0.0003), axis(0.00087)}));
  }
  void take_observation() {
    if (++intervals_ % 2 != 0) return;
    pictures_.push_back({now_s_ + 0.1, {{"op", "camera"}, {"slit", seen(slit())}, {"rod", seen(rod())}}});
  }
  Json state() const {
    Json angles = Json::array();
    for (std::int32_t i = 0; i < robot_.theta_count(); ++i)
      angles.push_back(arm_.theta_rad()[static_cast<std::size_t>(i)] / kDegree);
    return {{"op", "state"},
            {"time_s", now_s_},
            {"tick", intervals_},
            {"step", step_},
            {"device", device_},
            {"device_engaged", arm_.engaged()},
            {"mapping", mapping_},
            {"setpoint_cp", numbers(arm_.tip())},
            {"measured_cp", numbers(measured_tip())},
            {"measured_js_deg", angles}};
  }
  liana_state told() {
    liana_state out = device::make<liana_state>(LIANA_STATE, static_cast<std::uint32_t>(intervals_));
    out.flags = arm_.engaged() ? LIANA_ENGAGED | LIANA_IN_USE : LIANA_IN_USE;
    out.measured_cp = device::pose_of(measured_tip());
    out.setpoint_cp = device::pose_of(arm_.tip());
    const Vec3 speed = scale(subtract(measured_tip().position_m, before_m_), 1.0 / arm_.interval_s());
    std::copy(speed.begin(), speed.end(), out.measured_cv.linear_m_s);
    before_m_ = measured_tip().position_m;
    out.answers_us = made_of_us_;
    out.held_us = std::llround(1e6 * arm_.interval_s());  // as old as its command is: one interval
    return out;
  }

  void interval() {
    take_observation();
    station::News news{state(), {}, told()};
    for (; !pictures_.empty() && pictures_.front().due_s <= now_s_; pictures_.pop_front())
      news.pictures.push_back(pictures_.front().picture);
    std::vector<device::Sample> samples;
    for (const simulated::OperatorAnswer& answer : person_.on_news(news)) {
      samples.insert(samples.end(), answer.samples.begin(), answer.samples.end());
      for (const Json& message : answer.messages) said_ = said_ || message.value("step", -1) == index_;
    }
    arm_.interval(samples);
    made_of_us_ = arm_.made_of_us();
    now_s_ += arm_.interval_s();
    const Vec3 tip = true_tip_in_slit().position_m;
    if (tip[0] > 0.0) widest_m_ = std::max(widest_m_, std::fabs(tip[1]));
  }

  struct Picture {
    double due_s;
    Json picture;
  };

  HumanRigTable table_;
  cable::RobotParams robot_;
  config::SceneConfig scene_;
  LedArm arm_;
  station::Steering& person_;
  simulated::RandomStream noise_;
  Json step_, mapping_;
  std::string device_ = "none";
  std::deque<Picture> pictures_;
  Vec3 before_m_{};
  std::int64_t made_of_us_ = -1;
  std::int64_t intervals_ = 0;
  int index_ = 0;
  double now_s_ = 1.0;
  double widest_m_ = 0.0;
  bool said_ = false;
};

}  // namespace liana::test
